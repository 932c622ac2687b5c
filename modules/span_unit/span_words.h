// What the host loads into a span unit: the registers of figure 6 (000/001), for one of the two horizontal-sided halves
// of a triangle at a time. Words are bit patterns in two's complement; only the low bits of the register's width count.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "modules/span_unit/span.h"

namespace rastertlm::pixel_unit {
struct PixelTriangle;
}

namespace rastertlm::span_unit {

// A set of registers, quadratic on the screen: from pixel to pixel I += dI, dI += xx; from line to line I += dIstart
// and so on.
struct ColourWords {
  std::uint64_t start = 0;        // Istart, 0.5 included
  std::uint64_t line_step = 0;    // dIstart: to the next line's start
  std::uint64_t pixel_step = 0;   // dI(Xstart): to the next pixel, at the start
  std::uint64_t line_line = 0;    // of dIstart, a line: 2 (T5 A^2 + T4 A + T3)
  std::uint64_t line_pixel = 0;   // of dI(Xstart), a line: 2 T5 A + T4; and of dIstart, a carry
  std::uint64_t pixel_pixel = 0;  // of dI, a pixel: 2 T5
  friend bool operator==(const ColourWords&, const ColourWords&) = default;
};

inline ColourWords words_of(const StartEdgeRegisters& registers, std::size_t set) {
  return {registers.start[set],     registers.line_step[set],  registers.pixel_step[set],
          registers.line_line[set], registers.line_pixel[set], registers.pixel_pixel[set]};
}
inline void put_words(const ColourWords& words, std::size_t set, StartEdgeRegisters& registers) {
  registers.start[set] = words.start;
  registers.line_step[set] = words.line_step;
  registers.pixel_step[set] = words.pixel_step;
  registers.line_line[set] = words.line_line;
  registers.line_pixel[set] = words.line_pixel;
  registers.pixel_pixel[set] = words.pixel_pixel;
}

struct EdgeWords : EdgeRegisters {
  // Without a branch: carries come and go without a pattern.
  bool advance() {
    rest -= rest_step;
    const std::int64_t borrow = rest >> 63;  // -1: carries
    rest += divisor & borrow;
    column += step - borrow;
    return borrow != 0;
  }
  friend bool operator==(const EdgeWords&, const EdgeWords&) = default;
};

inline constexpr std::size_t kChannels = 3;

// Lines [first_line, first_line + lines): pixels from the start edge's column on, before the end edge's.
struct HalfTriangle {
  std::int64_t first_line = 0;
  std::int64_t lines = 0;
  EdgeWords start;
  EdgeWords end;
  StartEdgeRegisters registers;
};

// One or two halves; the second goes on where the first ends. A half whose start edge is the first's goes on with its
// registers and edge, and only its end edge is loaded.
struct TriangleLoad {
  std::array<HalfTriangle, 2> halves;
  std::size_t count = 0;
  bool wraps = false;           // prestep: a slope is more than its register holds as a signed number
  bool second_goes_on = false;  // with the start edge and its registers; otherwise with the end edge
  // For a pixel unit behind the span unit, which shades the triangle's pixels; stays where it is until the frame's end.
  // Null: the registers hold its colours.
  const pixel_unit::PixelTriangle* shading = nullptr;
  std::uint32_t object = 0;    // observer: from 1
  std::uint32_t material = 0;  // observer
};

}  // namespace rastertlm::span_unit
