#include "modules/span_unit/span_unit.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"

namespace rastertlm::span_unit {

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
      spans_(lines) {}

void SpanUnit::load(const HalfTriangle& half) {
  StartEdgeRegisters& r = registers_;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const ColourWords& words = half.colour[c];
    r.start[c] = words.start;
    r.line_step[c] = words.line_step;
    r.pixel_step[c] = words.pixel_step;
    r.line_line[c] = words.line_line;
    r.line_pixel[c] = words.line_pixel;
    r.pixel_pixel[c] = words.pixel_pixel;
  }
  r.start[kDepthSet] = half.depth.start;
  r.line_step[kDepthSet] = half.depth.line_step;
  r.pixel_step[kDepthSet] = half.depth.pixel_step;
}

// Registers wrap at 64 bits here: the low bits are those of narrower ones.
void SpanUnit::step_line(bool carries) {
  StartEdgeRegisters& r = registers_;
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    r.start[set] += r.line_step[set];
    r.pixel_step[set] += r.line_pixel[set];
    r.line_step[set] += r.line_line[set];
  }
  if (!(carries && lattice_)) return;
  ++counters_.carries;
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    r.start[set] += r.pixel_step[set];
    r.pixel_step[set] += r.pixel_pixel[set];
    r.line_step[set] += r.line_pixel[set];
  }
}

// I += f (dI - T5 (1 - f)), dI += 2 T5 f: f in prestep_bits, products floored.
void SpanUnit::prestep(const EdgeWords& start, Span& span) const {
  const auto bits = static_cast<unsigned>(parameters_.prestep_bits);
  const double distance = static_cast<double>(start.rest) / static_cast<double>(start.divisor);
  const std::int64_t f = round_half_up(distance * static_cast<double>(std::int64_t{1} << bits));
  const std::int64_t rest = (std::int64_t{1} << bits) - f;
  const auto times = [](std::int64_t value, std::int64_t factor, unsigned down) { return (value * factor) >> down; };
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    const auto word = static_cast<unsigned>(set == kDepthSet ? parameters_.depth_bits + parameters_.depth_fraction_bits
                                                             : parameters_.word_bits);
    const std::int64_t second = sign_extend(span.pixel_pixel[set], word);
    const std::int64_t step = sign_extend(span.di[set], word);
    span.i[set] += static_cast<std::uint64_t>(times(step - times(second, rest, bits + 1), f, bits));
    span.di[set] += static_cast<std::uint64_t>(times(second, f, bits));
  }
}

void SpanUnit::line(std::int64_t number, const Edges& edges, bool carries, Span& span) {
  const std::int64_t from = edges.start.column;
  const std::int64_t first = std::clamp<std::int64_t>(from, 0, columns_);
  const std::int64_t end = std::clamp<std::int64_t>(edges.end.column, first, columns_);
  span.line = static_cast<std::uint32_t>(number);
  span.column = static_cast<std::uint32_t>(first);
  span.count = static_cast<std::uint32_t>(end - first);
  // Several units that share the columns end a line together.
  const std::int64_t pixels = std::max<std::int64_t>(std::min(edges.end.column, columns_) - from, 0);
  const std::int64_t most = sharing_ == 1 ? pixels : (pixels + sharing_ - 1) / sharing_;
  const bool extra = carries && carry_takes_a_clock_;
  span.cycles =
      static_cast<std::uint64_t>(std::max<std::int64_t>(most * parameters_.pixel_cycles, 1) + (extra ? 1 : 0));
  counters_.pixels += span.count;
  counters_.empty_lines += span.count == 0 ? 1 : 0;
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    span.i[set] = registers_.start[set];
    span.di[set] = registers_.pixel_step[set];
    span.pixel_pixel[set] = registers_.pixel_pixel[set];
  }
  if (parameters_.start_edge == StartEdge::prestep) prestep(edges.start, span);
  if (from >= 0) return;
  counters_.off_screen +=
      static_cast<std::uint64_t>(std::max<std::int64_t>(std::min<std::int64_t>(edges.end.column, 0) - from, 0));
  const auto skipped = static_cast<std::uint64_t>(first - from);
  for (std::size_t set = 0; set < kRegisterSets; ++set) {
    span.i[set] += skipped * span.di[set] + skipped * (skipped - 1) / 2 * span.pixel_pixel[set];
    span.di[set] += skipped * span.pixel_pixel[set];
  }
}

std::span<const Span> SpanUnit::draw(const TriangleLoad& triangle) {
  ++counters_.triangles;
  std::size_t lines = 0;
  for (std::size_t h = 0; h < triangle.count; ++h) lines += static_cast<std::size_t>(triangle.halves[h].lines);
  if (lines > spans_.size()) spans_.resize(lines);
  counters_.lines += lines;
  Span* span = spans_.data();
  Edges edges;
  for (std::size_t h = 0; h < triangle.count; ++h) {
    const HalfTriangle& half = triangle.halves[h];
    const bool goes_on = h == 1 && triangle.second_goes_on;
    if (!goes_on) {
      load(half);
      edges.start = half.start;
    }
    if (h == 0 || goes_on) edges.end = half.end;
    bool carries = false;
    for (std::int64_t k = 0; k < half.lines; ++k) {
      // The step from the line before; from the first half's last line only where its registers go on.
      if (k > 0 || goes_on) {
        carries = edges.start.advance();
        step_line(carries);
      }
      if (k > 0 || (h == 1 && !goes_on)) edges.end.advance();
      line(half.first_line + k, edges, carries, *span++);
    }
  }
  return {spans_.data(), lines};
}

}  // namespace rastertlm::span_unit
