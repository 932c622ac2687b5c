// The pixels of a span, stepped from one to the next as figure 6 has it.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/span_unit/span.h"
#include "modules/span_unit/span_registers.h"

namespace rastertlm::test {

struct SpanPixels {
  std::vector<std::uint32_t> levels;  // red, green, blue from the low byte on
  std::vector<std::uint32_t> depths;
};

inline SpanPixels pixels_of(const span_unit::Span& span, const span_unit::PixelFormat& format) {
  SpanPixels pixels;
  pixels.levels.resize(span.count);
  pixels.depths.resize(span.count);
  for (std::size_t set = 0; set < span_unit::kRegisterSets; ++set) {
    const bool depth = set == span_unit::kDepthSet;
    span_unit::ColourRegisters registers(depth ? format.depth_bits + format.depth_fraction_bits : format.word_bits);
    registers.load({span.i[set], 0, span.di[set], 0, 0, span.pixel_pixel[set]});
    for (std::size_t x = 0; x < span.count; ++x) {
      if (depth)
        pixels.depths[x] = static_cast<std::uint32_t>(registers.i() >> format.depth_fraction_bits);
      else
        pixels.levels[x] |= span_unit::level_of(registers.i(), format.word_bits, format.fraction_bits) << (8 * set);
      registers.step_pixel();
    }
  }
  return pixels;
}

}  // namespace rastertlm::test
