// Edge equations of a triangle, positive or zero inside. Corners run so that the inside lies where
//   E(x, y) = dY (x - x0) - dX (y - y0) >= 0,   y down
// which is counter-clockwise to the eye.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "modules/set_up/word_format.h"
#include "src/geometry/counted.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up {

// The edge through two points of a grid of 2^-q pixel, in units of 2^-q square pixels. All terms are integers but the
// constant, which is rounded so that the sign bit alone is the top-left test: a sample on the edge is inside for left
// and top edges only. Exact: |E| < 2^(word_bits - 1) on the screen for points within the grid's guard band.
template <class T>
LinearWords snapped_edge(const geometry::SnappedPoint& from, const geometry::SnappedPoint& to, int q, int word_bits) {
  const std::int64_t a = to.y - from.y;
  const std::int64_t b = from.x - to.x;
  const bool top_left = a > 0 || (a == 0 && b > 0);
  const std::int64_t constant = -(a * from.x + b * from.y);  // in units of 4^-q
  // floor(c) for a top-left edge, ceil(c) - 1 for the others; >> is arithmetic.
  const std::int64_t c = (top_left ? constant : constant - 1) >> q;
  geometry::charge_integer<T>(9, 2);
  return loaded_words(a, b, c, word_bits);
}

template <class T>
struct ScreenPoint {
  T x;
  T y;
};

// The point of the segment on the screen's samples that is nearest the segment's middle; off the screen, a point of the
// segment near to it. Rounding a line about this point moves it least where it is seen.
template <class T>
ScreenPoint<T> anchor_of_edge(const ScreenPoint<T>& p, const ScreenPoint<T>& q, const WordFormat& format) {
  T first(0.0);
  T last(1.0);
  const T d[2] = {q.x - p.x, q.y - p.y};
  const T start[2] = {p.x, p.y};
  const double limit[2] = {static_cast<double>(format.columns) - 1, static_cast<double>(format.lines) - 1};
  for (int axis = 0; axis < 2; ++axis) {
    if (d[axis] == T(0.0)) continue;
    T enters = (T(0.0) - start[axis]) / d[axis];
    T leaves = (T(limit[axis]) - start[axis]) / d[axis];
    if (leaves < enters) std::swap(enters, leaves);
    if (enters > first) first = enters;
    if (leaves < last) last = leaves;
  }
  T t(0.5);
  if (first <= last) {
    if (t < first) t = first;
    if (t > last) t = last;
  } else {
    t = (first + last) * T(0.5);
    if (t < T(0.0)) t = T(0.0);
    if (t > T(1.0)) t = T(1.0);
  }
  return {p.x + t * d[0], p.y + t * d[1]};
}

// The edge from `p` to `q` (p before q in the canonical order) at the largest power-of-two scale at which no sample of
// the screen can leave the word, the rounding of the three terms included.
template <class T>
std::array<std::int64_t, 3> scaled_line(const ScreenPoint<T>& p, const ScreenPoint<T>& q, const WordFormat& format) {
  const T a = q.y - p.y;
  const T b = p.x - q.x;
  const ScreenPoint<T> anchor = anchor_of_edge(p, q, format);
  T largest(0.0);   // |E| over the corners
  T farthest(0.0);  // |dx| + |dy| from the anchor to a corner
  for (const double x : {0.0, static_cast<double>(format.columns) - 1})
    for (const double y : {0.0, static_cast<double>(format.lines) - 1}) {
      const T dx = T(x) - anchor.x;
      const T dy = T(y) - anchor.y;
      const T value = a * dx + b * dy;
      const T size = value < T(0.0) ? -value : value;
      const T distance = (dx < T(0.0) ? -dx : dx) + (dy < T(0.0) ? -dy : dy);
      if (size > largest) largest = size;
      if (distance > farthest) farthest = distance;
    }
  const T room = T(static_cast<double>(std::int64_t{1} << (format.word_bits - 1)) - 2.0) - T(0.5) * farthest;
  if (!(room > T(0.0)) || !(largest > T(0.0))) return {0, 0, -1};  // never so within the guard band
  int exponent = 0;
  std::frexp(geometry::plain(room / largest), &exponent);
  geometry::charge_integer<T>(4, 0);  // the power of two is taken from the exponent field
  const T scale = T(std::ldexp(1.0, std::clamp(exponent - 1, -1000, 1000)));
  const std::int64_t word_a = geometry::to_integer(a * scale);
  const std::int64_t word_b = geometry::to_integer(b * scale);
  const T constant = geometry::from_integer<T>(word_a) * anchor.x + geometry::from_integer<T>(word_b) * anchor.y;
  return {word_a, word_b, geometry::to_integer(-constant)};
}

// The edge at a scale of its own. Both neighbours compute the line from the same end first, and the one that walks it
// the other way takes the complement -A, -B, -C-1: a sample is on one side or on the other, never on both or neither.
// The line is displaced by at most 0.5 (|dx| + |dy| + 1) / |(A, B)| pixels, dx and dy from the anchor.
template <class T>
LinearWords scaled_edge(const ScreenPoint<T>& from, const ScreenPoint<T>& to, const WordFormat& format) {
  const bool in_order = from.x < to.x || (!(to.x < from.x) && from.y < to.y);
  std::array<std::int64_t, 3> line = in_order ? scaled_line(from, to, format) : scaled_line(to, from, format);
  if (!in_order) line = {-line[0], -line[1], -line[2] - 1};
  geometry::charge_integer<T>(4, 0);
  return loaded_words(line[0], line[1], line[2], format.word_bits);
}

}  // namespace rastertlm::set_up
