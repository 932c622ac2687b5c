#include "modules/span_unit/span_unit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/base/fixed_point.h"

namespace rastertlm::span_unit {
namespace {

// A word of each set of registers. They wrap at 64 bits here: the low bits are those of narrower ones.
using Words = std::uint64_t __attribute__((vector_size(kRegisterSets * sizeof(std::uint64_t))));

// The running registers at the start edge.
struct StartEdgeRegisters {
  Words start, line_step, pixel_step, line_line, line_pixel, pixel_pixel;

  explicit StartEdgeRegisters(const HalfTriangle& half) {
    const auto& [red, green, blue] = half.colour;
    const DepthWords& depth = half.depth;
    start = Words{red.start, green.start, blue.start, depth.start};
    line_step = Words{red.line_step, green.line_step, blue.line_step, depth.line_step};
    pixel_step = Words{red.pixel_step, green.pixel_step, blue.pixel_step, depth.pixel_step};
    line_line = Words{red.line_line, green.line_line, blue.line_line, 0};
    line_pixel = Words{red.line_pixel, green.line_pixel, blue.line_pixel, 0};
    pixel_pixel = Words{red.pixel_pixel, green.pixel_pixel, blue.pixel_pixel, 0};
  }
  // Carries come and go without a pattern: no branch.
  void step_line(bool carries) {
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    static constexpr Words kSecond[] = {{0, 0, 0, 0}, {kAll, kAll, kAll, kAll}};
    const Words second = kSecond[carries ? 1 : 0];
    start += line_step;
    pixel_step += line_pixel;
    line_step += line_line;
    start += pixel_step & second;
    pixel_step += pixel_pixel & second;
    line_step += line_pixel & second;
  }
  void put(Span& span) const {
    std::memcpy(span.i, &start, sizeof(start));
    std::memcpy(span.di, &pixel_step, sizeof(pixel_step));
    std::memcpy(span.pixel_pixel, &pixel_pixel, sizeof(pixel_pixel));
  }
};

}  // namespace

SpanCounters& SpanCounters::operator+=(const SpanCounters& other) {
  triangles += other.triangles;
  lines += other.lines;
  empty_lines += other.empty_lines;
  carries += other.carries;
  pixels += other.pixels;
  off_screen += other.off_screen;
  return *this;
}

PixelFormat pixel_format(const SpanUnitParameters& parameters) {
  return {static_cast<unsigned>(parameters.word_bits), static_cast<unsigned>(parameters.fraction_bits),
          static_cast<unsigned>(parameters.depth_bits), static_cast<unsigned>(parameters.depth_fraction_bits)};
}

SpanUnit::SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines)
    : parameters_(parameters),
      columns_(columns),
      sharing_(parameters.share == Share::columns ? parameters.units : 1),
      lattice_(parameters.start_edge == StartEdge::lattice),
      carry_takes_a_clock_(lattice_ && parameters.carry == Carry::clock),
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

void SpanUnit::note_shift(std::size_t line, const EdgeWords& start, const EdgeWords& end) {
  if (!shifted_) std::fill(shifts_.begin(), shifts_.end(), Shift{});
  shifted_ = true;
  Shift& shift = shifts_[line];
  if (parameters_.start_edge == StartEdge::prestep) {
    const double distance = static_cast<double>(start.rest) / static_cast<double>(start.divisor);
    shift.rest_bits = round_half_up(std::ldexp(distance, static_cast<int>(parameters_.prestep_bits)));
  }
  if (start.column >= 0) return;
  shift.skipped = static_cast<std::uint64_t>(-start.column);
  counters_.off_screen +=
      static_cast<std::uint64_t>(std::max<std::int64_t>(std::min<std::int64_t>(end.column, 0) - start.column, 0));
}

// Where the lines begin and end, and what they take.
DrawnLines SpanUnit::cross(const TriangleLoad& triangle, std::size_t lines) {
  const std::int64_t columns = columns_;
  const std::int64_t sharing = sharing_;
  const std::int64_t pixel_cycles = parameters_.pixel_cycles;
  const bool lattice = lattice_;
  const bool carry_clock = carry_takes_a_clock_;
  const bool prestepped = parameters_.start_edge == StartEdge::prestep;
  Span* const spans = spans_.data();
  std::uint8_t* const carried = carries_.data();
  shifted_ = false;
  std::uint64_t all_pixels = 0, all_cycles = 0, carries_made = 0, empty = 0;
  std::size_t line = 0;
  EdgeWords start;
  EdgeWords end;
  for (std::size_t h = 0; h < triangle.count; ++h) {
    const HalfTriangle& half = triangle.halves[h];
    // The step from the line before; from the first half's last line only where its edge goes on.
    const bool start_goes_on = h == 1 && triangle.second_goes_on;
    const bool end_goes_on = h == 1 && !triangle.second_goes_on;
    if (!start_goes_on) start = half.start;
    if (!end_goes_on) end = half.end;
    auto number = static_cast<std::uint32_t>(half.first_line);
    for (std::int64_t k = 0; k < half.lines; ++k, ++line, ++number) {
      const bool carries = (k > 0 || start_goes_on) && start.advance();
      if (k > 0 || end_goes_on) end.advance();
      const std::int64_t first = std::clamp<std::int64_t>(start.column, 0, columns);
      const std::int64_t last = std::clamp<std::int64_t>(end.column, first, columns);
      // Several units that share the columns end a line together.
      const std::int64_t stepped = std::max<std::int64_t>(std::min(end.column, columns) - start.column, 0);
      const std::int64_t most = sharing == 1 ? stepped : (stepped + sharing - 1) / sharing;
      Span& span = spans[line];
      span.line = number;
      span.column = static_cast<std::uint32_t>(first);
      span.count = static_cast<std::uint32_t>(last - first);
      span.cycles = static_cast<std::uint64_t>(std::max<std::int64_t>(most * pixel_cycles, 1)) +
                    static_cast<std::uint64_t>(carries && carry_clock);
      carried[line] = static_cast<std::uint8_t>(carries && lattice);
      carries_made += carried[line];
      all_pixels += span.count;
      all_cycles += span.cycles;
      empty += static_cast<std::uint64_t>(span.count == 0);
      if (start.column < 0 || prestepped) note_shift(line, start, end);
    }
  }
  counters_.carries += carries_made;
  counters_.pixels += all_pixels;
  counters_.empty_lines += empty;
  return {{spans, lines}, all_pixels, all_cycles};
}

// What the registers hold at each line.
void SpanUnit::step(const TriangleLoad& triangle, std::size_t lines) {
  std::size_t line = 0;
  StartEdgeRegisters registers(triangle.halves[0]);
  for (std::size_t h = 0; h < triangle.count; ++h) {
    const bool goes_on = h == 1 && triangle.second_goes_on;
    if (h == 1 && !goes_on) registers = StartEdgeRegisters(triangle.halves[1]);
    const std::size_t end = line + static_cast<std::size_t>(triangle.halves[h].lines);
    for (const std::size_t loaded = goes_on ? lines : line; line < end; ++line) {
      if (line != loaded) registers.step_line(carries_[line] != 0);
      registers.put(spans_[line]);
    }
  }
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
  const DrawnLines drawn = cross(triangle, lines);
  step(triangle, lines);
  if (shifted_)
    for (std::size_t line = 0; line < lines; ++line) shift(spans_[line], shifts_[line]);
  return drawn;
}

}  // namespace rastertlm::span_unit
