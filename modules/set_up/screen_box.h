// Boxes of pixels, and how large linear and second order forms get in them: templates over the number type T (double or
// geometry::Counted<double>).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

// Pixels left..right of lines top..bottom, all included; empty where an end is before its start.
struct PixelBox {
  std::int64_t left = 0;
  std::int64_t right = -1;
  std::int64_t top = 0;
  std::int64_t bottom = -1;
  bool empty() const { return left > right || top > bottom; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

inline PixelBox whole_screen(std::size_t columns, std::size_t lines) {
  return {0, static_cast<std::int64_t>(columns) - 1, 0, static_cast<std::int64_t>(lines) - 1};
}

template <class T>
PixelBox common_box(const PixelBox& a, const PixelBox& b) {
  geometry::charge_integer<T>(4, 0);
  return {std::max(a.left, b.left), std::min(a.right, b.right), std::max(a.top, b.top), std::min(a.bottom, b.bottom)};
}

// By a pixel on each side, within the screen; an empty one stays empty.
template <class T>
PixelBox grown(const PixelBox& box, const PixelBox& screen) {
  if (box.empty()) return box;
  geometry::charge_integer<T>(4, 0);
  return common_box<T>({box.left - 1, box.right + 1, box.top - 1, box.bottom + 1}, screen);
}

template <class T>
T magnitude(const T& value) {
  return value < T(0.0) ? -value : value;
}

template <class T>
struct Range {
  T least;
  T most;

  void include(const T& value) {
    if (value < least) least = value;
    if (most < value) most = value;
  }
  T largest_magnitude() const {
    const T below = magnitude(least), above = magnitude(most);
    return below < above ? above : below;
  }
};

template <class T>
Range<T> range_in(const geometry::LinearForm<T>& form, const PixelBox& box) {
  const T x[2] = {form.x * T(static_cast<double>(box.left)), form.x * T(static_cast<double>(box.right))};
  const T y[2] = {form.y * T(static_cast<double>(box.top)), form.y * T(static_cast<double>(box.bottom))};
  const bool falls_x = x[1] < x[0], falls_y = y[1] < y[0];
  return {x[falls_x ? 1 : 0] + y[falls_y ? 1 : 0] + form.one, x[falls_x ? 0 : 1] + y[falls_y ? 0 : 1] + form.one};
}

// Of all points of the box, not of its pixels alone: corners, where a side has an extreme, and the middle of an
// ellipse.
template <class T>
Range<T> range_in(const geometry::SecondOrderForm<T>& form, const PixelBox& box) {
  const auto left = static_cast<double>(box.left), right = static_cast<double>(box.right);
  const auto top = static_cast<double>(box.top), bottom = static_cast<double>(box.bottom);
  const T at_first = form.at(left, top);
  Range<T> range{at_first, at_first};
  range.include(form.at(right, top));
  range.include(form.at(left, bottom));
  range.include(form.at(right, bottom));
  const auto include_inside = [&](double x, double y) {
    if (x > left && x < right && y >= top && y <= bottom) range.include(form.at(x, y));
  };
  const auto is_zero = [](const T& value) { return !(value < T(0.0)) && !(T(0.0) < value); };
  if (!is_zero(form.xx)) {
    const T factor = T(-0.5) / form.xx;
    for (const double y : {top, bottom}) include_inside(geometry::plain((form.xy * T(y) + form.x) * factor), y);
  }
  if (!is_zero(form.yy)) {
    const T factor = T(-0.5) / form.yy;
    for (const double x : {left, right}) {
      const double y = geometry::plain((form.xy * T(x) + form.y) * factor);
      if (y > top && y < bottom) range.include(form.at(x, y));
    }
  }
  const T determinant = T(4.0) * form.xx * form.yy - form.xy * form.xy;
  if (T(0.0) < determinant) {
    const T factor = T(1.0) / determinant;
    include_inside(geometry::plain((form.xy * form.y - T(2.0) * form.yy * form.x) * factor),
                   geometry::plain((form.xy * form.x - T(2.0) * form.xx * form.y) * factor));
  }
  return range;
}

// Where a form that falls in all directions from its middle is positive.
template <class T>
struct Ellipse {
  T x, y;          // its middle
  T at_middle;     // the form's value there
  T across, down;  // squares of half its width and height, for each unit of the value

  bool middle_in(const PixelBox& box) const {
    const double column = geometry::plain(x), line = geometry::plain(y);
    geometry::charge_integer<T>(4, 0);
    return column >= static_cast<double>(box.left) && column <= static_cast<double>(box.right) &&
           line >= static_cast<double>(box.top) && line <= static_cast<double>(box.bottom);
  }
  // The pixels where form + `more` may be 0 or positive.
  PixelBox box(const T& more, const PixelBox& screen) const {
    const T value = at_middle + more;
    if (value < T(0.0)) return {};
    // Half widths are of rounded coefficients: to be safe, 2^-10 pixel and a millionth more.
    constexpr double kMore = 0x1p-10, kFactor = 1 + 0x1p-20;
    const T half_x = geometry::square_root(value * across) * T(kFactor) + T(kMore);
    const T half_y = geometry::square_root(value * down) * T(kFactor) + T(kMore);
    const auto first = [](const T& at, std::int64_t least) {
      return static_cast<std::int64_t>(std::ceil(std::clamp(geometry::plain(at), static_cast<double>(least), 0x1p40)));
    };
    const auto last = [](const T& at, std::int64_t most) {
      return static_cast<std::int64_t>(std::floor(std::clamp(geometry::plain(at), -0x1p40, static_cast<double>(most))));
    };
    if constexpr (!std::is_arithmetic_v<T>) geometry::operation_counts.convert += 4;
    geometry::charge_integer<T>(4, 0);  // clamped
    return {first(x - half_x, screen.left), last(x + half_x, screen.right), first(y - half_y, screen.top),
            last(y + half_y, screen.bottom)};
  }
};

// Nothing where the form has no highest point, or so flat a one that double has not enough digits for it.
template <class T>
std::optional<Ellipse<T>> ellipse_of(const geometry::SecondOrderForm<T>& form) {
  constexpr double kFlat = 0x1p-36;
  if (!(form.xx < T(0.0)) || !(form.yy < T(0.0))) return std::nullopt;
  const T product = T(4.0) * form.xx * form.yy;
  const T determinant = product - form.xy * form.xy;
  if (!(product * T(kFlat) < determinant)) return std::nullopt;
  const T factor = T(1.0) / determinant;
  const T x = (form.xy * form.y - T(2.0) * form.yy * form.x) * factor;
  const T y = (form.xy * form.x - T(2.0) * form.xx * form.y) * factor;
  const T at_middle = form.one + (form.x * x + form.y * y) * T(0.5);
  for (const T& value : {x, y, at_middle, factor})
    if (!std::isfinite(geometry::plain(value))) return std::nullopt;
  return Ellipse<T>{x, y, at_middle, T(-4.0) * form.yy * factor, T(-4.0) * form.xx * factor};
}

}  // namespace rastertlm::set_up
