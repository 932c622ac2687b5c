// The runs of inside pixels of a processor on a line, whatever its edges do: for the two forms in which a board gives a
// line.
#pragma once

#include "modules/object_processor/object_board.h"

namespace rastertlm::object_processor {

// Calls `draw` with each run of inside pixels of `span`.
template <class Draw>
void ObjectBoard::visit_spans(const LineEdges& at, Interval span, const Draw& draw) {
  const auto last_column = static_cast<std::int32_t>(columns_) - 1;
  std::uint32_t wrapping = 0;
  for (std::size_t edge = 0; edge < 3; ++edge) {
    if (stays_inside(at.edges[edge], last_column))
      narrow(at.edges[edge], span);
    else
      wrapping |= 1U << edge;
  }
  if (span.empty()) return;
  if (wrapping == 0)
    draw(span);
  else
    visit_stepped(at, wrapping, span, draw);
}

// Edges that could wrap are looked at pixel by pixel.
template <class Draw>
void ObjectBoard::visit_stepped(const LineEdges& at, std::uint32_t wrapping, Interval span, const Draw& draw) {
  counters_.pixels_stepped += static_cast<std::uint64_t>(span.end - span.begin);
  std::int32_t run = span.begin;
  for (std::int32_t column = span.begin; column <= span.end; ++column) {
    bool inside = column < span.end;
    for (std::size_t edge = 0; inside && edge < 3; ++edge) {
      if ((wrapping >> edge & 1U) == 0) continue;
      const std::uint32_t word = static_cast<std::uint32_t>(at.edges[edge].start) +
                                 static_cast<std::uint32_t>(at.edges[edge].step) * static_cast<std::uint32_t>(column);
      inside = (word >> 31) == 0;
    }
    if (inside) continue;
    if (run < column) draw({run, column});
    run = column + 1;
  }
}

}  // namespace rastertlm::object_processor
