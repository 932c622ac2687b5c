// What the host loads into a span unit: the registers of figure 6 (000/001), for one of the two horizontal-sided halves
// of a triangle at a time. Words are bit patterns in two's complement; only the low bits of the register's width count.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rastertlm::span_unit {

// Quadratic on the screen: from pixel to pixel I += dI, dI += xx; from line to line I += dIstart and so on.
struct ColourWords {
  std::uint64_t start = 0;        // Istart, 0.5 included
  std::uint64_t line_step = 0;    // dIstart: to the next line's start
  std::uint64_t pixel_step = 0;   // dI(Xstart): to the next pixel, at the start
  std::uint64_t line_line = 0;    // of dIstart, a line: 2 (T5 A^2 + T4 A + T3)
  std::uint64_t line_pixel = 0;   // of dI(Xstart), a line: 2 T5 A + T4; and of dIstart, a carry
  std::uint64_t pixel_pixel = 0;  // of dI, a pixel: 2 T5
  friend bool operator==(const ColourWords&, const ColourWords&) = default;
};

// Linear: the same without second differences.
struct DepthWords {
  std::uint64_t start = 0;
  std::uint64_t line_step = 0;
  std::uint64_t pixel_step = 0;
  friend bool operator==(const DepthWords&, const DepthWords&) = default;
};

// The first column at or right of an edge, line by line, in integers: column - rest / divisor is where the edge stands.
// 0 <= rest, rest_step < divisor. A line: column += step, rest -= rest_step; where that is negative, rest += divisor
// and column += 1: the carry.
struct EdgeWords {
  std::int64_t column = 0;
  std::int64_t step = 0;  // floor of the slope
  std::int64_t rest = 0;
  std::int64_t rest_step = 0;
  std::int64_t divisor = 1;

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
  std::array<ColourWords, kChannels> colour;
  DepthWords depth;
};

// One or two halves; the second goes on where the first ends. A half whose start edge is the first's goes on with its
// registers and edge, and only its end edge is loaded.
struct TriangleLoad {
  std::array<HalfTriangle, 2> halves;
  std::size_t count = 0;
  bool second_goes_on = false;  // with the start edge and its registers; otherwise with the end edge
  std::uint32_t object = 0;     // observer: from 1
  std::uint32_t material = 0;   // observer
};

}  // namespace rastertlm::span_unit
