// Planes of depth and normal through the snapped corners of a triangle, rounded to words and anchored where the
// triangle is seen: slopes are rounded first, then the constant, so that the errors of the slopes only act over the
// distance from the anchor. For slivers slopes exceed the word; every term is modulo 2^word_bits and the sum is right
// all the same.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "modules/set_up/word_format.h"
#include "src/geometry/counted.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up {

__extension__ using WideInteger = __int128;

// Slopes below it, and what is made of them with an anchor, are computed in 64 bits: those of all but slivers.
inline constexpr double kNarrowSlope = 0x1p31;

// Round half up; 0 where the value is beyond any slope of a triangle on a grid, or is not a number. 64 bits are given
// no value of 2^62 or more.
template <class Integer, class T>
Integer to_slope_integer(T value) {
  if constexpr (!std::is_arithmetic_v<T>) ++geometry::operation_counts.convert;
  const double plain = geometry::plain(value);
  if constexpr (sizeof(Integer) == sizeof(std::int64_t)) {
    return round_half_up(plain);
  } else {
    constexpr double kLimit = 0x1p90;
    const double rounded = std::floor(plain + 0.5);
    return rounded > -kLimit && rounded < kLimit ? static_cast<Integer>(rounded) : Integer{0};
  }
}

// Fits planes through three values at the corners, in units of the word, any number of them.
// Error at a covered pixel: at most 0.5 (|dx| + |dy| + 1) units, dx and dy from the anchor, which is the centre of the
// visible part of the triangle's bounding box: at most 0.5 ((w + h) / 2 + 1), w and h the sides of the box.
template <class T>
class PlaneFit {
 public:
  // `area` is doubled_area of the corners, not zero.
  PlaneFit(const std::array<geometry::SnappedPoint, 3>& corners, std::int64_t area, int fraction_bits,
           const WordFormat& format);

  LinearWords fit(const std::array<T, 3>& values) const;

 private:
  template <class Integer>
  LinearWords round(const T& slope_x, const T& slope_y, const T& at_anchor) const;

  // Twice the middle of [low, high], both moved onto [0, limit] first.
  static std::int64_t doubled_middle(std::int64_t low, std::int64_t high, std::int64_t limit) {
    return std::clamp<std::int64_t>(low, 0, limit) + std::clamp<std::int64_t>(high, 0, limit);
  }

  int word_bits_;
  int anchor_bits_;  // the anchor is in units of 2^-anchor_bits pixel
  double fraction_unit_;
  std::int64_t anchor_x_;
  std::int64_t anchor_y_;
  T edge1_x_, edge1_y_;  // from corner 0, over the doubled area and in pixels: slopes are sums of products with them
  T edge2_x_, edge2_y_;
  T weight1_, weight2_;  // barycentric, of the anchor
};

template <class T>
PlaneFit<T>::PlaneFit(const std::array<geometry::SnappedPoint, 3>& corners, std::int64_t area, int fraction_bits,
                      const WordFormat& format)
    : word_bits_(format.word_bits),
      anchor_bits_(fraction_bits + 1),
      fraction_unit_(1.0 / static_cast<double>(std::int64_t{1} << anchor_bits_)) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  anchor_x_ = doubled_middle(left, right, (static_cast<std::int64_t>(format.columns) - 1) << fraction_bits);
  anchor_y_ = doubled_middle(top, bottom, (static_cast<std::int64_t>(format.lines) - 1) << fraction_bits);
  const std::int64_t e1x = corners[1].x - corners[0].x;
  const std::int64_t e1y = corners[1].y - corners[0].y;
  const std::int64_t e2x = corners[2].x - corners[0].x;
  const std::int64_t e2y = corners[2].y - corners[0].y;
  const std::int64_t ax = anchor_x_ - 2 * corners[0].x;
  const std::int64_t ay = anchor_y_ - 2 * corners[0].y;
  geometry::charge_integer<T>(28, 4);  // comparisons of the box and its clamping, differences, two cross products
  const T reciprocal = T(1.0) / geometry::from_integer<T>(area);
  const T per_pixel = reciprocal * T(static_cast<double>(std::int64_t{1} << fraction_bits));
  edge1_x_ = geometry::from_integer<T>(e1x) * per_pixel;
  edge1_y_ = geometry::from_integer<T>(e1y) * per_pixel;
  edge2_x_ = geometry::from_integer<T>(e2x) * per_pixel;
  edge2_y_ = geometry::from_integer<T>(e2y) * per_pixel;
  const T half = reciprocal * T(0.5);
  weight1_ = geometry::from_integer<T>(ax * e2y - ay * e2x) * half;
  weight2_ = geometry::from_integer<T>(ay * e1x - ax * e1y) * half;
}

template <class T>
LinearWords PlaneFit<T>::fit(const std::array<T, 3>& values) const {
  const T d1 = values[1] - values[0];
  const T d2 = values[2] - values[0];
  const T slope_x = d1 * edge2_y_ - d2 * edge1_y_;
  const T slope_y = d2 * edge1_x_ - d1 * edge2_x_;
  const T at_anchor = values[0] + d1 * weight1_ + d2 * weight2_;
  const auto narrow = [](const T& value, double limit) { return std::fabs(geometry::plain(value)) < limit; };
  constexpr double kNarrowValue = 0x1p60;
  if (narrow(slope_x, kNarrowSlope) && narrow(slope_y, kNarrowSlope) && narrow(at_anchor, kNarrowValue))
    return round<std::int64_t>(slope_x, slope_y, at_anchor);
  return round<WideInteger>(slope_x, slope_y, at_anchor);
}

template <class T>
template <class Integer>
LinearWords PlaneFit<T>::round(const T& slope_x, const T& slope_y, const T& at_anchor) const {
  const auto a = to_slope_integer<Integer>(slope_x);
  const auto b = to_slope_integer<Integer>(slope_y);
  // round(at_anchor - a x - b y) at the anchor: the whole part of a x + b y apart from its fraction, so that nothing is
  // lost where slopes are steep.
  const Integer sum = a * anchor_x_ + b * anchor_y_;
  const Integer whole = sum >> anchor_bits_;
  const auto below = static_cast<std::int64_t>(sum - (whole << anchor_bits_));  // 0 .. 2^anchor_bits - 1
  const double fraction = static_cast<double>(below) * fraction_unit_;
  const Integer c = to_slope_integer<Integer>(at_anchor - T(fraction)) - whole;
  geometry::charge_integer<T>(6, 2);
  // Slopes may be wider than 64 bits on the finest grids; the word is their lowest bits.
  return loaded_words(static_cast<std::int64_t>(a), static_cast<std::int64_t>(b), static_cast<std::int64_t>(c),
                      word_bits_);
}

}  // namespace rastertlm::set_up
