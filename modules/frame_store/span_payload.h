// What crosses the links between a span unit and the frame store: one transaction a span.
#pragma once

#include <cstdint>
#include <tlm>

#include "modules/span_unit/span_unit.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::frame_store {

struct SpanPayload : tlm::tlm_generic_payload {
  enum class Kind { frame, span, end };
  Kind kind = Kind::span;
  std::uint64_t frame = 0;
  const span_unit::Span* span = nullptr;  // span; its pixels are the unit's, for the call
  std::uint32_t object = 0;
  std::uint32_t material = 0;
  std::uint64_t shown_ps = 0;  // end, set by the store: when the frame is shown
};
using SpanProtocol = stream::Protocol<SpanPayload>;

}  // namespace rastertlm::frame_store
