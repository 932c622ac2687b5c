// What the host processors say to each other over their serial links.
#pragma once

#include <cstdint>
#include <tlm>
#include <vector>

#include "modules/host/animation.h"
#include "modules/host/computation.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::host {

struct HostMessage : tlm::tlm_generic_payload {
  enum class Kind { frame, survey, plan };
  Kind kind = Kind::frame;
  std::uint64_t bytes = 0;               // as they cross the link
  const FrameWork* work = nullptr;       // frame: down, from the animation unit
  bool guarded = false;                  // survey: up, some triangle needs the guard band; plan: down, the frame uses it
  std::vector<ForeignPieces> foreign;    // survey: pieces without a slot on their own board; plan: who draws them
};

using HostProtocol = stream::Protocol<HostMessage>;

}  // namespace rastertlm::host
