// What crosses the links between a span unit and the frame store: one transaction a triangle, or a span.
#pragma once

#include <cstdint>
#include <span>
#include <tlm>

#include "modules/span_unit/span.h"
#include "modules/stream/line_payload.h"

namespace rastertlm::pixel_unit {
struct PixelTriangle;
}

namespace rastertlm::frame_store {

struct SpanPayload : tlm::tlm_generic_payload {
  enum class Kind { frame, spans, end };
  Kind kind = Kind::spans;
  std::uint64_t frame = 0;
  // frame, set by the store: the memory takes pixels as fast as they can come. Spans of a triangle may then come in one
  // transaction, which takes no time of its own; otherwise one by one, each when the last has been taken.
  bool keeps_up = false;
  std::span<const span_unit::Span> spans;  // spans, the sender's for the call
  std::uint64_t pixels = 0;                // of all of them
  // Of all pixels, one after the other, red, green, blue from the low byte on, where a unit gives them; none: they are
  // the spans' registers'.
  std::span<const std::uint32_t> levels;
  // Of the triangle, where a pixel unit between sender and store shades it.
  const pixel_unit::PixelTriangle* shading = nullptr;
  std::uint32_t object = 0;
  std::uint32_t material = 0;
  std::uint64_t shown_ps = 0;  // end, set by the store: when the frame is shown
};
using SpanProtocol = stream::Protocol<SpanPayload>;

}  // namespace rastertlm::frame_store
