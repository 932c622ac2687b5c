// Linear and second order forms as words of elementary processors, anchored: what has the highest order is rounded
// first, then what is left at the anchor, so that rounding acts only over the distance from there.
//
// With (u, v) from the anchor and k = |u| + |v|, in units of the words' last place:
//   linear         at most (k + 1) / 2: half a unit of the value at the anchor, half a unit a pixel of each slope;
//   second order   at most (k^2 + 2 k + 2) / 4: the value half a unit, slopes half a unit a pixel, and 2A, 2B, C half a
//                  unit each of u^2 / 2, v^2 / 2, u v, which are (|u| + |v|)^2 / 2 together. The forward differences'
//                  u (u - 1) / 2 is u^2 / 2 once slopes are rounded that hold half of the rounded 2A and 2B.
#pragma once

#include <cmath>
#include <cstdint>

#include "modules/object_processor/second_order_processor.h"
#include "modules/quadric_processor/quadric_words.h"
#include "modules/set_up/screen_box.h"
#include "src/base/fixed_point.h"
#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

struct Anchor {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

template <class T>
Anchor middle_of(const PixelBox& box) {
  geometry::charge_integer<T>(4, 0);
  return {(box.left + box.right) / 2, (box.top + box.bottom) / 2};
}

constexpr double linear_error(double pixels) { return (pixels + 1) / 2; }
constexpr double second_order_error(double pixels) { return (pixels * pixels + 2 * pixels + 2) / 4; }

// |u| + |v| to the farthest pixel of the box.
template <class T>
double farthest(const Anchor& anchor, const PixelBox& box) {
  geometry::charge_integer<T>(7, 0);
  return static_cast<double>(std::max(std::abs(box.left - anchor.x), std::abs(box.right - anchor.x)) +
                             std::max(std::abs(box.top - anchor.y), std::abs(box.bottom - anchor.y)));
}

// Coefficients beyond it have no place in the integers here; differences of three values of 60 bits have.
inline constexpr double kLargestCoefficient = 0x1p61;

template <class T>
bool has_integer(const T& value) {
  return std::fabs(geometry::plain(value)) <= kLargestCoefficient;
}
// 0 where it has none: callers refuse such forms, or none of the values that they show can be right.
template <class T>
std::int64_t to_word(const T& value) {
  return geometry::to_integer(has_integer(value) ? value : T(0.0));
}

// a x + b y + c on pixel (x, y), modulo 2^64.
struct IntegerPlane {
  std::uint64_t a = 0, b = 0, c = 0;
};

template <class T>
IntegerPlane anchored_plane(const geometry::LinearForm<T>& form, const Anchor& anchor) {
  const auto a = static_cast<std::uint64_t>(to_word(form.x)), b = static_cast<std::uint64_t>(to_word(form.y));
  const auto at_anchor =
      static_cast<std::uint64_t>(to_word(form.at(static_cast<double>(anchor.x), static_cast<double>(anchor.y))));
  geometry::charge_integer<T>(3, 2);  // with C - B
  return {a, b, at_anchor - a * static_cast<std::uint64_t>(anchor.x) - b * static_cast<std::uint64_t>(anchor.y)};
}

inline quadric_processor::PlaneWords plane_words(const IntegerPlane& plane, unsigned bits) {
  const std::uint64_t mask = low_mask(bits);
  return {plane.a & mask, plane.b & mask, (plane.c - plane.b) & mask};
}

template <class T>
object_processor::SecondOrderWords anchored_second_order(const geometry::SecondOrderForm<T>& form, const Anchor& anchor,
                                                         unsigned bits) {
  using Word = std::uint64_t;
  const std::int64_t two_a = to_word(T(2.0) * form.xx), two_b = to_word(T(2.0) * form.yy), c = to_word(form.xy);
  const auto x = static_cast<double>(anchor.x), y = static_cast<double>(anchor.y);
  const T half_a = geometry::from_integer<T>(two_a) * T(0.5), half_b = geometry::from_integer<T>(two_b) * T(0.5);
  const T slope_x = T(2.0) * form.xx * T(x) + form.xy * T(y) + form.x;
  const T slope_y = T(2.0) * form.yy * T(y) + form.xy * T(x) + form.y;
  // As differences from the anchor on, then moved to pixel (0, 0).
  const auto step_x = static_cast<Word>(to_word(slope_x + half_a)),
             step_y = static_cast<Word>(to_word(slope_y + half_b));
  const auto value = static_cast<Word>(to_word(form.at(x, y)));
  const auto wide_a = static_cast<Word>(two_a), wide_b = static_cast<Word>(two_b), wide_c = static_cast<Word>(c);
  const auto left = static_cast<Word>(anchor.x), up = static_cast<Word>(anchor.y);
  const auto pairs_before = [](Word n) { return n * (n + 1) / 2; };  // (-n) (-n - 1) / 2
  geometry::charge_integer<T>(16, 11);
  const Word mask = low_mask(bits);
  return {(value - left * step_x - up * step_y + pairs_before(left) * wide_a + pairs_before(up) * wide_b +
           left * up * wide_c) &
              mask,
          (step_y - up * wide_b - left * wide_c) & mask,
          wide_b & mask,
          (step_x - left * wide_a - up * wide_c) & mask,
          wide_c & mask,
          wide_a & mask};
}

}  // namespace rastertlm::set_up
