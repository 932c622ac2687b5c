// What the host tells the table loader of a frame's lights: a message that carries constant vectors, in eye space.
#pragma once

#include <array>
#include <cstdint>
#include <tlm>
#include <vector>

#include "modules/shading/deferred_shader.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::shading {

struct LightPayload : tlm::tlm_generic_payload {
  bool initial = false;                // the first frame: materials are new too
  bool changed = false;                // false: the tables stay as they are
  std::vector<LightArguments> lights;  // all of the scene
};

using LightProtocol = stream::Protocol<LightPayload>;

}  // namespace rastertlm::shading
