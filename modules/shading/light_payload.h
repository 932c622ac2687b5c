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
  bool changed = false;                // false: the tables stay as they are
  bool will_change = false;            // later frames bring other lights: a second bank will be used
  std::vector<LightArguments> lights;  // all of the scene
};

// A header of two words, and for each light its vector, its highlight vector and its intensity.
constexpr std::uint64_t light_words(std::size_t lights) { return 2 + 9 * lights; }

using LightProtocol = stream::Protocol<LightPayload>;

}  // namespace rastertlm::shading
