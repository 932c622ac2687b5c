// Which samples a triangle covers: three signs a sample and the top-left rule, exact for integers.
//
// With N = int64 the edge functions are exact, and so is the coverage. With N = double an edge function is rounded, but
// it is computed from the edge's end points in a canonical order: the two triangles beside an edge see the same number
// with opposite signs, so that a sample on or near the edge still belongs to exactly one of them. A value of exactly 0
// is decided by the top-left rule.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rastertlm::reference {

// x to the right, y down, in units of 1 / step pixel.
template <class N>
struct Point {
  N x{};
  N y{};
};

// One side of a triangle whose corners run clockwise as seen: positive inside.
template <class N>
class Side {
 public:
  Side() = default;
  Side(Point<N> from, Point<N> to) {
    // Clockwise on a screen whose y points down: an edge that goes up has the inside on its right, as has a horizontal
    // one that goes right.
    top_left_ = to.y < from.y || (to.y == from.y && to.x > from.x);
    reversed_ = to.x < from.x || (to.x == from.x && to.y < from.y);
    if (reversed_) std::swap(from, to);
    origin_ = from;
    dx_ = to.x - from.x;
    dy_ = to.y - from.y;
  }

  // Twice the area of the triangle made by the side and the sample.
  N value(N x, N y) const {
    const N v = dx_ * (y - origin_.y) - dy_ * (x - origin_.x);
    return reversed_ ? -v : v;
  }
  bool covers(N x, N y) const {
    const N v = value(x, y);
    return v > N(0) || (v == N(0) && top_left_);
  }
  // +1: covered samples of a line lie to the right of the side; -1: to the left; 0: the side is horizontal.
  int inward() const {
    if (dy_ == N(0)) return 0;
    return (dy_ < N(0)) != reversed_ ? 1 : -1;
  }
  // Where the side's line meets line y, about; not for horizontal sides.
  double crossing(N y) const {
    return static_cast<double>(origin_.x) +
           static_cast<double>(dx_) * static_cast<double>(y - origin_.y) / static_cast<double>(dy_);
  }

 private:
  Point<N> origin_;
  N dx_{};
  N dy_{};
  bool reversed_ = false;
  bool top_left_ = false;
};

// Half-open range of columns.
struct Span {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

template <class N>
class Coverage {
 public:
  // The corners run clockwise as seen (doubled area > 0); the sample of pixel (i, j) is at (i * step, j * step).
  Coverage(const std::array<Point<N>, 3>& corners, N step) : step_(step) {
    for (std::size_t i = 0; i < 3; ++i) sides_[i] = Side<N>(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    columns_ = around(left, right);
    lines_ = around(top, bottom);
  }

  // Lines that may hold covered samples, of the `count` lines of the screen.
  Span lines(std::size_t count) const { return cut(lines_, count); }

  // The covered columns of a line, of the `count` columns of the screen. What a side covers of a line is a half-line,
  // for rounding is monotone: the estimate by division only tells where to start looking.
  Span span(std::int64_t line, std::size_t count) const {
    Span span = cut(columns_, count);
    const N y = static_cast<N>(line) * step_;
    for (const Side<N>& side : sides_) {
      if (span.begin >= span.end) return {};
      const int inward = side.inward();
      if (inward == 0) {
        if (!side.covers(N(0), y)) return {};
        continue;
      }
      const double estimate = std::ceil(side.crossing(y) / static_cast<double>(step_));
      const double clamped = std::clamp(estimate, static_cast<double>(span.begin), static_cast<double>(span.end));
      auto x = static_cast<std::int64_t>(clamped);
      const bool left_part = inward < 0;  // covered up to x, else from x on
      while (x > span.begin && covers(side, x - 1, y) != left_part) --x;
      while (x < span.end && covers(side, x, y) == left_part) ++x;
      (left_part ? span.end : span.begin) = x;
    }
    return span;
  }

  // Weights of the second and third corner at a covered sample; that of the first is what is left to 1. All in 0..1
  // whatever the shape, because no side is negative at a covered sample.
  std::array<double, 2> weights(std::int64_t column, std::int64_t line) const {
    const N x = static_cast<N>(column) * step_;
    const N y = static_cast<N>(line) * step_;
    const N first = sides_[0].value(x, y);
    const N second = sides_[1].value(x, y);
    const N third = sides_[2].value(x, y);
    const N sum = first + second + third;
    if (!(sum > N(0))) return {0.0, 0.0};
    return {static_cast<double>(second) / static_cast<double>(sum),
            static_cast<double>(third) / static_cast<double>(sum)};
  }

 private:
  // A sample more than needed at each end, so that the signs alone decide, also where a corner is within rounding of a
  // sample.
  Span around(N low, N high) const {
    const auto step = static_cast<double>(step_);
    return {static_cast<std::int64_t>(std::floor(static_cast<double>(low) / step)),
            static_cast<std::int64_t>(std::ceil(static_cast<double>(high) / step)) + 1};
  }
  static Span cut(const Span& span, std::size_t count) {
    return {std::max<std::int64_t>(span.begin, 0), std::min(span.end, static_cast<std::int64_t>(count))};
  }
  bool covers(const Side<N>& side, std::int64_t column, N y) const {
    return side.covers(static_cast<N>(column) * step_, y);
  }

  std::array<Side<N>, 3> sides_;  // side i is opposite corner i
  N step_;
  Span columns_;
  Span lines_;
};

}  // namespace rastertlm::reference
