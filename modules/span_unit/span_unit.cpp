#include "modules/span_unit/span_unit.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"

namespace rastertlm::span_unit {

SpanUnit::SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines,
                   VectorVariant variant)
    : parameters_(parameters),
      columns_(columns),
      lines_(lines),
      narrow_(parameters.word_bits <= 32),
      lattice_(parameters.start_edge == StartEdge::lattice),
      kernels_(pixel_kernels(variant)),
      levels_(columns + kSparePixels),
      depths_(columns + kSparePixels) {}

void SpanUnit::load(const HalfTriangle& half) { state_ = {half.colour, half.depth}; }

// Registers wrap at 64 bits here: the low bits are those of narrower ones.
void SpanUnit::step_line(bool carries) {
  const bool second = carries && lattice_;
  counters_.carries += second ? 1 : 0;
  for (ColourWords& c : state_.colour) {
    c.start += c.line_step;
    c.pixel_step += c.line_pixel;
    c.line_step += c.line_line;
    if (!second) continue;
    c.start += c.pixel_step;
    c.pixel_step += c.pixel_pixel;
    c.line_step += c.line_pixel;
  }
  state_.depth.start += state_.depth.line_step;
  if (second) state_.depth.start += state_.depth.pixel_step;
}

// Several units that share the columns end a line together.
std::uint64_t SpanUnit::cycles_of(const Line& line) const {
  const std::int64_t units = parameters_.share == Share::columns ? parameters_.units : 1;
  const std::int64_t pixels = std::max<std::int64_t>(std::min(line.end, columns_) - line.first, 0);
  const std::int64_t most = units == 1 ? pixels : (pixels + units - 1) / units;
  const bool extra = line.carries && lattice_ && parameters_.carry == Carry::clock;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(most * parameters_.pixel_cycles, 1) + (extra ? 1 : 0));
}

// I += f (dI - T5 (1 - f)), dI += 2 T5 f: f in prestep_bits, products floored.
void SpanUnit::prestep(const Line& line, PixelRequest& request) const {
  const auto bits = static_cast<unsigned>(parameters_.prestep_bits);
  const auto word = static_cast<unsigned>(parameters_.word_bits);
  const double distance = static_cast<double>(line.rest) / static_cast<double>(line.divisor);
  const std::int64_t f = round_half_up(distance * static_cast<double>(std::int64_t{1} << bits));
  const std::int64_t rest = (std::int64_t{1} << bits) - f;
  const auto times = [](std::int64_t value, std::int64_t factor, unsigned down) { return (value * factor) >> down; };
  for (auto& channel : request.colour) {
    const std::int64_t second = sign_extend(channel.pixel_pixel, word);
    const std::int64_t step = sign_extend(channel.di, word);
    channel.i += static_cast<std::uint64_t>(times(step - times(second, rest, bits + 1), f, bits));
    channel.di += static_cast<std::uint64_t>(times(second, f, bits));
  }
  const auto depth_word = static_cast<unsigned>(parameters_.depth_bits + parameters_.depth_fraction_bits);
  request.depth += static_cast<std::uint32_t>(times(sign_extend(request.depth_step, depth_word), f, bits));
}

Span SpanUnit::pixels(const Line& line) {
  Span span;
  ++counters_.lines;
  span.line = static_cast<std::uint32_t>(line.line);
  span.cycles = cycles_of(line);
  const std::int64_t first = std::clamp<std::int64_t>(line.first, 0, columns_);
  const std::int64_t end = std::clamp<std::int64_t>(line.end, first, columns_);
  counters_.off_screen +=
      static_cast<std::uint64_t>(std::max<std::int64_t>(std::min<std::int64_t>(line.end, 0) - line.first, 0));
  span.column = static_cast<std::uint32_t>(first);
  span.count = static_cast<std::uint32_t>(end - first);
  if (span.count == 0) {
    ++counters_.empty_lines;
    return span;
  }
  counters_.pixels += span.count;
  PixelRequest request;
  for (std::size_t c = 0; c < kChannels; ++c)
    request.colour[c] = {state_.colour[c].start, state_.colour[c].pixel_step, state_.colour[c].pixel_pixel};
  request.depth = static_cast<std::uint32_t>(state_.depth.start);
  request.depth_step = static_cast<std::uint32_t>(state_.depth.pixel_step);
  if (parameters_.start_edge == StartEdge::prestep) prestep(line, request);
  const auto skipped = static_cast<std::uint64_t>(first - line.first);
  if (skipped > 0) {
    for (auto& channel : request.colour) {
      channel.i += skipped * channel.di + skipped * (skipped - 1) / 2 * channel.pixel_pixel;
      channel.di += skipped * channel.pixel_pixel;
    }
    request.depth += static_cast<std::uint32_t>(skipped) * request.depth_step;
  }
  request.word_bits = static_cast<unsigned>(parameters_.word_bits);
  request.fraction_bits = static_cast<unsigned>(parameters_.fraction_bits);
  request.depth_fraction_bits = static_cast<unsigned>(parameters_.depth_fraction_bits);
  request.depth_mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters_.depth_bits)));
  request.count = span.count;
  request.levels = levels_.data();
  request.depths = depths_.data();
  (narrow_ ? kernels_.narrow : kernels_.wide)(request);
  span.levels = levels_.data();
  span.depths = depths_.data();
  return span;
}

}  // namespace rastertlm::span_unit
