// A board's line as pixels.
#include <algorithm>

#include "modules/object_processor/object_board.h"
#include "modules/object_processor/visit_spans.h"

namespace rastertlm::object_processor {

namespace {

// The depth comparator along a span. Word: as what words are compared; narrower ones than 32 bits are not negative, and
// vector units without unsigned comparisons do those faster as signed.
template <class Word>
void compare_depth(std::uint32_t depth, std::uint32_t step, std::uint32_t mask, std::uint32_t mark,
                   std::uint32_t* __restrict nearest, std::uint32_t* __restrict winner, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t word = depth & mask;
    const bool wins = static_cast<Word>(word) < static_cast<Word>(nearest[i]);
    nearest[i] = wins ? word : nearest[i];
    winner[i] = wins ? mark : winner[i];
    depth += step;
  }
}

}  // namespace

void ObjectBoard::evaluate_line(std::uint32_t line, frame::FragmentLine& out) {
  check_line(line, out.columns());
  if (bands_.touched_by(line) == 0) return;
  ++counters_.lines_evaluated;
  counters_.processors_visited += bands_.touched_by(line);
  touched_ = {static_cast<std::int32_t>(columns_), 0};
  for (const std::uint32_t slot : bands_.active(line))
    if (intervals_[slot].holds(static_cast<std::int32_t>(line))) evaluate_processor(slot, line, out);
  if (!touched_.empty()) resolve_winners(line, out);
}

void ObjectBoard::evaluate_processor(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out) {
  if (late_carry_) {
    evaluate_late_carry(slot, line, out);
    return;
  }
  const LineEdges at = line_edges(slot, line);
  visit_spans(at, {0, static_cast<std::int32_t>(columns_)},
              [&](const Interval& span) { draw_span(slot, at, span, out); });
}

// The line in two pieces: column 0, and the rest, which is linear.
void ObjectBoard::evaluate_late_carry(std::uint32_t slot, std::uint32_t line, frame::FragmentLine& out) {
  const TriangleWords triangle = backup(slot);
  LineEdges first{};
  LineEdges rest{};
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const LateCarryLine late = late_carry_line(triangle.edges[edge], parameters_, line);
    first.edges[edge] = format_.on_line(0, 0, late.first, line);
    rest.edges[edge] = format_.on_line(triangle.edges[edge].a, 0, late.start, line);
  }
  const LateCarryLine depth = late_carry_line(triangle.depth, parameters_, line);
  first.depth = depth.first;
  rest.depth = depth.start;
  rest.depth_step = triangle.depth.a;
  visit_spans(first, {0, 1}, [&](const Interval& span) { draw_span(slot, first, span, out); });
  visit_spans(rest, {1, static_cast<std::int32_t>(columns_)},
              [&](const Interval& span) { draw_span(slot, rest, span, out); });
}

void ObjectBoard::draw_span(std::uint32_t slot, const LineEdges& at, Interval span, frame::FragmentLine& out) {
  const auto begin = static_cast<std::uint32_t>(span.begin);
  const auto end = static_cast<std::uint32_t>(span.end);
  const std::uint32_t mask = format_.mask();
  out.extend(begin, end, mask);
  touched_.begin = std::min(touched_.begin, span.begin);
  touched_.end = std::max(touched_.end, span.end);
  counters_.fragments_in += end - begin;
  const std::uint32_t start = at.depth + at.depth_step * begin;
  const std::size_t count = end - begin;
  if (format_.bits() < 32)
    compare_depth<std::int32_t>(start, at.depth_step, mask, slot + 1, out.depth.data() + begin, winner_.data() + begin,
                                count);
  else
    compare_depth<std::uint32_t>(start, at.depth_step, mask, slot + 1, out.depth.data() + begin, winner_.data() + begin,
                                 count);
  std::uint16_t* __restrict coverage = out.coverage.data();
  for (std::uint32_t column = begin; column < end; ++column) ++coverage[column];
}

void ObjectBoard::resolve_winners(std::uint32_t line, frame::FragmentLine& out) {
  const auto begin = static_cast<std::size_t>(touched_.begin);
  const auto end = static_cast<std::size_t>(touched_.end);
  std::uint64_t seen = 0;
  const std::uint64_t in_before = counters_.fragments_kept + counters_.fragments_hidden;
  for (std::size_t column = begin; column < end;) {
    if (winner_[column] == 0) {
      column += winner_[column + 1] == 0 ? 2 : 1;
      continue;
    }
    // A stretch of pixels that this board shows, by runs of one winner; winner_[columns] is 0 and ends the last.
    const std::size_t stretch = column;
    while (winner_[column] != 0) {
      const std::uint32_t winner = winner_[column];
      const std::size_t run = column;
      while (winner_[column] == winner) ++column;
      fill_run(winner - 1, line, run, column, out);
    }
    std::fill(winner_.begin() + static_cast<std::ptrdiff_t>(stretch),
              winner_.begin() + static_cast<std::ptrdiff_t>(column), 0U);
    prenormaliser_.line({normal_[0].data() + stretch, normal_[1].data() + stretch, normal_[2].data() + stretch},
                        {out.normal_x.data() + stretch, out.normal_y.data() + stretch, out.normal_z.data() + stretch},
                        column - stretch);
    seen += column - stretch;
  }
  counters_.fragments_kept += seen;
  counters_.fragments_hidden += counters_.fragments_in - in_before - seen;
}

void ObjectBoard::fill_run(std::uint32_t slot, std::uint32_t line, std::size_t begin, std::size_t end,
                           frame::FragmentLine& out) {
  const frame::FragmentSource& source = sources_[slot];
  const auto first = static_cast<std::uint32_t>(begin);
  const auto last = static_cast<std::uint32_t>(end);
  for (std::size_t component = 0; component < 3; ++component) {
    const frame::WordPlane& plane = source.normal[component];
    const std::uint32_t step = plane.a;
    std::uint32_t* __restrict normal = normal_[component].data();
    std::uint32_t start = plane.b * (line + 1) + plane.c;
    if (late_carry_) {
      const LateCarryLine late = late_carry_line({step, plane.b, plane.c}, parameters_, line);
      start = late.start;
      if (begin == 0) normal[0] = late.first;
    }
    const std::uint32_t from = late_carry_ ? std::max(first, 1U) : first;
    std::uint32_t word = start + step * from;
    for (std::uint32_t column = from; column < last; ++column) {
      normal[column] = word;
      word += step;
    }
  }
  const auto material = static_cast<std::uint8_t>(source.material);
  const std::uint32_t object = source.object;
  std::uint8_t* __restrict materials = out.material.data();
  std::uint32_t* __restrict objects = out.object.data();
  for (std::size_t column = begin; column < end; ++column) {
    materials[column] = material;
    objects[column] = object;
  }
}

}  // namespace rastertlm::object_processor
