// What the registers of figure 6 (000/001) hold: where a triangle starts, and at the first pixel of each of its lines.
// Kernels are compiled for several instruction sets and include this header: it holds nothing but numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rastertlm::span_unit {

// Sets of registers: red, green, blue, and depth, which is linear.
inline constexpr std::size_t kDepthSet = 3;
inline constexpr std::size_t kRegisterSets = 4;

// The registers at the start edge; not set where nothing is given. From line to line start += line_step, pixel_step +=
// line_pixel, line_step += line_line; with a pixel more, start += pixel_step, pixel_step += pixel_pixel, line_step +=
// line_pixel. Only the low bits of the registers' widths count.
struct alignas(32) StartEdgeRegisters {
  std::uint64_t start[kRegisterSets];        // Istart, 0.5 included
  std::uint64_t line_step[kRegisterSets];    // dIstart: to the next line's start
  std::uint64_t pixel_step[kRegisterSets];   // dI(Xstart): to the next pixel, at the start
  std::uint64_t line_line[kRegisterSets];    // 2 (T5 A^2 + T4 A + T3)
  std::uint64_t line_pixel[kRegisterSets];   // 2 T5 A + T4
  std::uint64_t pixel_pixel[kRegisterSets];  // 2 T5
};

// The first column at or right of an edge, line by line, in integers: column - rest / divisor is where the edge stands.
// 0 <= rest, rest_step < divisor. A line: column += step, rest -= rest_step; where that is negative, rest += divisor
// and column += 1: the carry.
struct EdgeRegisters {
  std::int64_t column = 0;
  std::int64_t step = 0;  // floor of the slope
  std::int64_t rest = 0;
  std::int64_t rest_step = 0;
  std::int64_t divisor = 1;
  friend bool operator==(const EdgeRegisters&, const EdgeRegisters&) = default;
};

// A line of a triangle. Its pixels are what `i` shows after 0, 1, 2 ... steps of a pixel: I += dI, dI += pixel_pixel.
// Only the low bits of the registers' widths count. No set of registers lies across two lines of a cache.
struct alignas(64) Span {
  std::uint32_t line = 0;
  std::uint32_t column = 0;  // of the first pixel that is on the screen
  std::uint32_t count = 0;   // pixels that are; may be none
  std::uint64_t cycles = 0;  // that the unit takes for the line, pixels off the screen and a carry included
  alignas(32) std::uint64_t i[kRegisterSets] = {};
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
