// Where on the screen the words of a quadric processor can cover a pixel: never less, and as little more as is cheap.
// The words are looked at as the real functions that they are where none of them wraps; one that could bounds nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/object_processor/interval.h"
#include "modules/quadric_processor/parameters.h"
#include "modules/quadric_processor/quadric_pixel.h"
#include "modules/quadric_processor/quadric_words.h"

namespace rastertlm::quadric_processor {

using object_processor::Interval;

// a x + b y + c.
struct RealPlane {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  double at(double x, double y) const { return a * x + b * y + c; }
};

// xx x^2 + yy y^2 + xy x y + x x + y y + one.
struct RealConic {
  double xx = 0.0, yy = 0.0, xy = 0.0, x = 0.0, y = 0.0, one = 0.0;
  double at(double px, double py) const { return (xx * px + xy * py + x) * px + (yy * py + y) * py + one; }
};

// Columns of a line in up to two pieces.
struct LinePieces {
  std::array<Interval, 2> piece{};
  std::size_t count = 0;
  void add(const Interval& columns) {
    if (!columns.empty()) piece[count++] = columns;
  }
};

class SolidRegion {
 public:
  SolidRegion() = default;
  // `columns` and `lines` 1..16384.
  SolidRegion(const QuadricWords& words, const QuadricParameters& parameters, const DepthRange& range,
              std::int32_t columns, std::int32_t lines);

  const Interval& lines() const { return lines_; }
  LinePieces columns(std::int32_t line) const;
  std::uint64_t memory_bytes() const {  // beside itself
    return polygon_.capacity() * sizeof(Point) + planes_.capacity() * sizeof(RealPlane);
  }

 private:
  struct Point {
    double x = 0.0;
    double y = 0.0;
  };
  using Polygon = std::vector<Point>;

  void bound_by_caps(const QuadricWords& words, const std::array<RealPlane, kMostCaps>& caps, std::size_t count,
                     const DepthRange& range);
  void bound_by_roots(const QuadricWords& words, const RealPlane& middle, double root,
                      const std::array<RealPlane, kMostCaps>& caps, std::size_t count, const DepthRange& range);
  void keep(const RealPlane& plane);  // where it is not negative
  double largest_on_polygon() const;
  void find_lines(bool by_conic);
  bool holds(const Point& point) const;

  std::int32_t columns_ = 0;
  Interval lines_;
  bool conic_bounds_ = false;  // nothing is covered where the conic is negative
  RealConic conic_;
  Polygon polygon_;                // the screen and what planes leave of it
  std::vector<RealPlane> planes_;  // that cut something from it
};

}  // namespace rastertlm::quadric_processor
