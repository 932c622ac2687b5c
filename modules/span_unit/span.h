// A line of a triangle as it leaves the span unit: what the registers of figure 6 (000/001) hold at its first pixel.
// Kernels are compiled for several instruction sets and include this header: it holds nothing but numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rastertlm::span_unit {

// Sets of registers: red, green, blue, and depth, which is linear.
inline constexpr std::size_t kDepthSet = 3;
inline constexpr std::size_t kRegisterSets = 4;

// Its pixels are what `i` shows after 0, 1, 2 ... steps of a pixel: I += dI, dI += pixel_pixel. Only the low bits of
// the registers' widths count.
struct Span {
  std::uint32_t line = 0;
  std::uint32_t column = 0;  // of the first pixel that is on the screen
  std::uint32_t count = 0;   // pixels that are; may be none
  std::uint64_t cycles = 0;  // that the unit takes for the line, pixels off the screen and a carry included
  std::uint64_t i[kRegisterSets] = {};
  std::uint64_t di[kRegisterSets] = {};
  std::uint64_t pixel_pixel[kRegisterSets] = {};  // depth: 0
};

// How levels and depths are read from the registers.
struct PixelFormat {
  unsigned word_bits = 32;      // of a colour, 64 at most
  unsigned fraction_bits = 20;  // of it; 0.5 has been added to the start
  unsigned depth_bits = 24;     // that are compared; with those below it 32 at most
  unsigned depth_fraction_bits = 8;
};

}  // namespace rastertlm::span_unit
