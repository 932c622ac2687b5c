#include "modules/span_unit/span_unit.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"

namespace rastertlm::span_unit {
namespace {

void put(const StartEdgeRegisters& registers, Span& span) {
  std::copy(std::begin(registers.start), std::end(registers.start), span.i);
  std::copy(std::begin(registers.pixel_step), std::end(registers.pixel_step), span.di);
  std::copy(std::begin(registers.pixel_pixel), std::end(registers.pixel_pixel), span.pixel_pixel);
}

}  // namespace

SpanCounters& SpanCounters::operator+=(const SpanCounters& other) {
  triangles += other.triangles;
  lines += other.lines;
  empty_lines += other.empty_lines;
  carries += other.carries;
  pixels += other.pixels;
  off_screen += other.off_screen;
  steps = std::max(steps, other.steps);
  return *this;
}

PixelFormat pixel_format(const SpanUnitParameters& parameters) {
  return {static_cast<unsigned>(parameters.word_bits), static_cast<unsigned>(parameters.fraction_bits),
          static_cast<unsigned>(parameters.depth_bits), static_cast<unsigned>(parameters.depth_fraction_bits)};
}

SpanUnit::SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines,
                   VectorVariant variant)
    : parameters_(parameters),
      columns_(columns),
      sharing_(parameters.share == Share::columns ? parameters.units : 1),
      lattice_(parameters.start_edge == StartEdge::lattice),
      prestepped_(parameters.start_edge == StartEdge::prestep),
      carry_takes_a_clock_(lattice_ && parameters.carry == Carry::clock),
      kernels_(line_kernels(variant)),
      spans_(lines),
      carries_(lines),
      shifts_(lines) {}

// What a line's first pixel on the screen is from where its registers stand. Prestep: I += f (dI - T5 (1 - f)),
// dI += 2 T5 f, f in prestep_bits, products floored. Then the pixels left of the screen.
void SpanUnit::shift(Span& span, const Shift& at) const {
  const auto bits = static_cast<unsigned>(parameters_.prestep_bits);
  const auto times = [](std::int64_t value, std::int64_t factor, unsigned down) { return (value * factor) >> down; };
  const std::int64_t f = at.rest_bits;
  const std::int64_t rest = (std::int64_t{1} << bits) - f;
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    if (f != 0) {
      const auto word = static_cast<unsigned>(
          set == kDepthSet ? parameters_.depth_bits + parameters_.depth_fraction_bits : parameters_.word_bits);
      const std::int64_t second = sign_extend(span.pixel_pixel[set], word);
      const std::int64_t step = sign_extend(span.di[set], word);
      span.i[set] += static_cast<std::uint64_t>(times(step - times(second, rest, bits + 1), f, bits));
      span.di[set] += static_cast<std::uint64_t>(times(second, f, bits));
    }
    const std::uint64_t skipped = at.skipped;
    span.i[set] += skipped * span.di[set] + skipped * (skipped - 1) / 2 * span.pixel_pixel[set];
    span.di[set] += skipped * span.pixel_pixel[set];
  }
}

SpanUnit::Shift SpanUnit::shift_of(const EdgeWords& start, const EdgeWords& end) {
  Shift shift;
  if (prestepped_) {
    const double distance = static_cast<double>(start.rest) / static_cast<double>(start.divisor);
    shift.rest_bits = round_half_up(std::ldexp(distance, static_cast<int>(parameters_.prestep_bits)));
  }
  if (start.column >= 0) return shift;
  shift.skipped = static_cast<std::uint64_t>(-start.column);
  counters_.off_screen +=
      static_cast<std::uint64_t>(std::max<std::int64_t>(std::min<std::int64_t>(end.column, 0) - start.column, 0));
  return shift;
}

// Is every pixel that is stepped through on the screen? Columns move by `step` or one more a line.
bool SpanUnit::lies_on_screen(const Drawing& drawing, std::int64_t lines) const {
  const EdgeWords &start = drawing.start, &end = drawing.end;
  const std::int64_t leftmost = start.column + std::min<std::int64_t>(start.step, 0) * lines;
  const std::int64_t rightmost = end.column + std::max<std::int64_t>(end.step + 1, 0) * lines;
  return leftmost >= 0 && rightmost <= columns_;
}

// Nothing to clip, no other unit: edges and registers in one go.
void SpanUnit::draw_on_screen(const HalfTriangle& half, Drawing& drawing) {
  HalfLines lines;
  lines.start = &drawing.start;
  lines.end = &drawing.end;
  lines.start_goes_on = drawing.start_goes_on ? -1 : 0;
  lines.end_goes_on = drawing.end_goes_on ? -1 : 0;
  lines.carry_steps = lattice_ ? -1 : 0;
  lines.carry_cycles = carry_takes_a_clock_ ? 1 : 0;
  lines.pixel_cycles = parameters_.pixel_cycles;
  lines.first_line = static_cast<std::uint32_t>(half.first_line);
  lines.lines = static_cast<std::size_t>(half.lines);
  const HalfSums sums = kernels_.half(lines, drawing.start_goes_on ? drawing.registers : half.registers,
                                      drawing.registers, spans_.data() + drawing.line);
  drawing.pixels += sums.pixels;
  drawing.cycles += sums.cycles;
  counters_.carries += sums.carries;
  counters_.empty_lines += sums.empty_lines;
  // Both edges are straight: no line between the first and the last is wider than either, but for rounding.
  const Span& first = spans_[drawing.line];
  const Span& last = spans_[drawing.line + lines.lines - 1];
  drawing.widest = std::max(drawing.widest, std::max(first.count, last.count) + 1);
}

// Where the lines of a half begin and end, and what they take.
void SpanUnit::cross(const HalfTriangle& half, Drawing& drawing) {
  EdgeWords start = drawing.start, end = drawing.end;
  for (std::int64_t k = 0; k < half.lines; ++k) {
    const bool carries = (k > 0 || drawing.start_goes_on) && start.advance();
    if (k > 0 || drawing.end_goes_on) end.advance();
    const std::int64_t first = std::clamp<std::int64_t>(start.column, 0, columns_);
    const std::int64_t last = std::clamp<std::int64_t>(end.column, first, columns_);
    // Several units that share the columns end a line together.
    const std::int64_t stepped = std::max<std::int64_t>(std::min(end.column, columns_) - start.column, 0);
    const std::int64_t most = (stepped + sharing_ - 1) / sharing_;
    drawing.widest = std::max(drawing.widest, static_cast<std::uint32_t>(stepped));
    const std::size_t line = drawing.line + static_cast<std::size_t>(k);
    Span& span = spans_[line];
    span.line = static_cast<std::uint32_t>(half.first_line + k);
    span.column = static_cast<std::uint32_t>(first);
    span.count = static_cast<std::uint32_t>(last - first);
    span.cycles = static_cast<std::uint64_t>(std::max<std::int64_t>(most * parameters_.pixel_cycles, 1)) +
                  (carries && carry_takes_a_clock_ ? 1U : 0U);
    carries_[line] = carries && lattice_ ? 1 : 0;
    counters_.carries += carries_[line];
    counters_.empty_lines += span.count == 0 ? 1 : 0;
    drawing.pixels += span.count;
    drawing.cycles += span.cycles;
    shifts_[line] = shift_of(start, end);
  }
  drawing.start = start;
  drawing.end = end;
}

// What the registers hold at each line of a half.
void SpanUnit::step(const HalfTriangle& half, Drawing& drawing) {
  std::size_t line = drawing.line;
  const std::size_t end = line + static_cast<std::size_t>(half.lines);
  if (!drawing.start_goes_on) {
    drawing.registers = half.registers;
    put(drawing.registers, spans_[line++]);
  }
  kernels_.step(drawing.registers, carries_.data() + line, end - line, spans_.data() + line);
  for (line = drawing.line; line < end; ++line) shift(spans_[line], shifts_[line]);
}

DrawnLines SpanUnit::draw(const TriangleLoad& triangle) {
  std::size_t lines = 0;
  for (std::size_t h = 0; h < triangle.count; ++h) lines += static_cast<std::size_t>(triangle.halves[h].lines);
  if (lines > spans_.size()) {
    spans_.resize(lines);
    carries_.resize(lines);
    shifts_.resize(lines);
  }
  ++counters_.triangles;
  counters_.lines += lines;
  const std::uint64_t carries_before = counters_.carries;
  Drawing drawing;
  for (std::size_t h = 0; h < triangle.count; ++h) {
    const HalfTriangle& half = triangle.halves[h];
    // The step from the line before; from the first half's last line only where its edge goes on.
    drawing.start_goes_on = h == 1 && triangle.second_goes_on;
    drawing.end_goes_on = h == 1 && !triangle.second_goes_on;
    if (!drawing.end_goes_on) drawing.end = half.end;
    if (!drawing.start_goes_on) drawing.start = half.start;
    if (sharing_ == 1 && !prestepped_ && lies_on_screen(drawing, half.lines)) {
      draw_on_screen(half, drawing);
    } else {
      cross(half, drawing);
      step(half, drawing);
    }
    drawing.line += static_cast<std::size_t>(half.lines);
  }
  counters_.pixels += drawing.pixels;
  counters_.steps = std::max(counters_.steps, lines + counters_.carries - carries_before + drawing.widest);
  return {{spans_.data(), lines}, drawing.pixels, drawing.cycles};
}

}  // namespace rastertlm::span_unit
