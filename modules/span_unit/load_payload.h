// What crosses the bus between the set-up processor and a span unit. The payload derives from tlm_generic_payload
// because the simple sockets ask for it; its command, address and data mean nothing here.
#pragma once

#include <cstdint>
#include <tlm>

#include "modules/span_unit/span_words.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::span_unit {

struct LoadPayload : tlm::tlm_generic_payload {
  enum class Kind { frame, triangle, end };
  Kind kind = Kind::triangle;
  std::uint64_t frame = 0;
  const TriangleLoad* load = nullptr;  // triangle
  std::uint64_t words = 0;             // triangle: that are written
  std::uint64_t write_ps = 0;          // triangle: what they take on the bus
  std::uint64_t blocked_ps = 0;        // triangle, set by the unit: how long no register set was free
  std::uint64_t shown_ps = 0;          // end, set by the frame store: when the frame is shown
};
using LoadProtocol = stream::Protocol<LoadPayload>;

}  // namespace rastertlm::span_unit
