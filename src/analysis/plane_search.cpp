#include "src/analysis/plane_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "modules/object_processor/line_evaluator.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

__extension__ using Quad = __float128;
using geometry::SnapGrid;
using geometry::SnappedPoint;

struct Sample {
  std::int64_t x, y;  // columns and lines
};

// Twice the area of two corners and a sample, in grid squares; positive on the inside of front faces.
std::int64_t edge_value(const SnappedPoint& from, const SnappedPoint& to, const Sample& s, int q) {
  return (to.y - from.y) * ((s.x << q) - from.x) - (to.x - from.x) * ((s.y << q) - from.y);
}

class PlaneSearch {
 public:
  PlaneSearch(const set_up::WordFormat& format, const geometry::SnapGrids& grids, Numbers& numbers, double large)
      : format_(format),
        grids_(grids),
        numbers_(numbers),
        large_(large),
        word_(static_cast<unsigned>(format.word_bits)) {}

  void triangle(PlaneFamily family) {
    const SnapGrid& grid = family == PlaneFamily::guarded ? grids_.guarded : grids_.on_screen;
    const bool scaled = format_.edges == set_up::EdgeForm::scaled;
    q_ = scaled ? set_up::kScaledFractionBits : grid.fraction_bits;
    do {
      for (SnappedPoint& p : corners_) p = corner(family, grid);
      if (family == PlaneFamily::sliver) make_thin();
      area_ = geometry::doubled_area(corners_[0], corners_[1], corners_[2]);
    } while (area_ == 0);
    if (area_ > 0) std::swap(corners_[1], corners_[2]);
    area_ = -std::llabs(area_);
    make_values(family);
    const auto result = set_up::set_up_triangle<double>(screen_, 0, false, grid, format_);
    if (result.outcome != set_up::Outcome::drawn) return;
    words_ = result.words;
    ++seen_.triangles;
    constexpr int kSamples = 24;
    for (const SnappedPoint& p : corners_) look_at(sample_near(p));
    for (int i = 0; i < kSamples; ++i) look_at(inner_sample());
    for (int i = 0; i < kSamples; ++i) look_at({numbers_.whole(0, last_x()), numbers_.whole(0, last_y())});
  }

  const PlaneSeen& seen() const { return seen_; }

 private:
  std::int64_t last_x() const { return static_cast<std::int64_t>(format_.columns) - 1; }
  std::int64_t last_y() const { return static_cast<std::int64_t>(format_.lines) - 1; }

  SnappedPoint corner(PlaneFamily family, const SnapGrid& grid) {
    const std::int64_t guard_x = family == PlaneFamily::guarded ? grid.guard_x : 0;
    const std::int64_t guard_y = family == PlaneFamily::guarded ? grid.guard_y : 0;
    const bool outermost = family == PlaneFamily::corners || numbers_.whole(0, 3) == 0;
    if (outermost) return {outermost_of(last_x(), guard_x), outermost_of(last_y(), guard_y)};
    SnappedPoint p{numbers_.whole(-guard_x << q_, (last_x() + guard_x) << q_),
                   numbers_.whole(-guard_y << q_, (last_y() + guard_y) << q_)};
    if (numbers_.whole(0, 2) == 0) p = {p.x >> q_ << q_, p.y >> q_ << q_};
    return p;
  }

  std::int64_t outermost_of(std::int64_t last, std::int64_t guard) {
    switch (numbers_.whole(0, 2)) {
      case 0:
        return -guard * (std::int64_t{1} << q_);
      case 1:
        return (last + guard) << q_;
      default:
        return numbers_.whole(0, last) << q_;
    }
  }

  // The third corner next to the line through the others.
  void make_thin() {
    const SnappedPoint &a = corners_[0], &b = corners_[1];
    const double t = numbers_.uniform(0, 1);
    corners_[2] = {round_half_up(static_cast<double>(a.x) + t * static_cast<double>(b.x - a.x)),
                   round_half_up(static_cast<double>(a.y) + t * static_cast<double>(b.y - a.y))};
    corners_[2].x = std::clamp<std::int64_t>(corners_[2].x + numbers_.whole(-1, 1), 0, last_x() << q_);
    corners_[2].y = std::clamp<std::int64_t>(corners_[2].y + numbers_.whole(-1, 1), 0, last_y() << q_);
  }

  void make_values(PlaneFamily family) {
    const double step = std::ldexp(1.0, -q_);
    const bool extreme = family == PlaneFamily::corners || numbers_.whole(0, 1) == 0;
    for (std::size_t i = 0; i < 3; ++i) {
      auto& vertex = screen_[i];
      vertex.x = static_cast<double>(corners_[i].x) * step;
      vertex.y = static_cast<double>(corners_[i].y) * step;
      vertex.z = extreme ? static_cast<double>(numbers_.whole(0, 1)) : numbers_.uniform(0, 1);
      for (int c = 0; c < 3; ++c)
        vertex.normal[c] = extreme ? static_cast<double>(2 * numbers_.whole(0, 1) - 1) : numbers_.uniform(-1, 1);
    }
  }

  Sample on_screen(double x, double y) const {
    return {std::clamp<std::int64_t>(round_half_up(x), 0, last_x()),
            std::clamp<std::int64_t>(round_half_up(y), 0, last_y())};
  }
  Sample sample_near(const SnappedPoint& p) const {
    return on_screen(std::ldexp(static_cast<double>(p.x), -q_), std::ldexp(static_cast<double>(p.y), -q_));
  }
  Sample inner_sample() {
    const double v = numbers_.uniform(0, 1), w = numbers_.uniform(0, 1 - v);
    return on_screen(screen_[0].x + v * (screen_[1].x - screen_[0].x) + w * (screen_[2].x - screen_[0].x),
                     screen_[0].y + v * (screen_[1].y - screen_[0].y) + w * (screen_[2].y - screen_[0].y));
  }

  void look_at(const Sample& s) {
    std::array<std::int64_t, 3> inside{};  // twice the area against each edge, positive inside
    for (std::size_t e = 0; e < 3; ++e) {
      inside[e] = edge_value(corners_[e], corners_[(e + 1) % 3], s, q_);
      look_at_edge(s, e, inside[e]);
    }
    if (inside[0] < 0 || inside[1] < 0 || inside[2] < 0) return;
    ++seen_.samples;
    const auto exact = [&](const std::array<Quad, 3>& v) {
      // Edge e is opposite of corner e + 2.
      return (inside[1] * v[0] + inside[2] * v[1] + inside[0] * v[2]) / static_cast<Quad>(-area_);
    };
    const auto depth_range = static_cast<double>(set_up::far_depth(format_) - set_up::near_depth(format_));
    std::array<Quad, 3> values{};
    for (std::size_t i = 0; i < 3; ++i)
      values[i] = static_cast<Quad>(screen_[i].z) * depth_range + static_cast<double>(set_up::near_depth(format_));
    const double depth = off(words_.depth, s, exact(values));
    seen_.depth = std::max(seen_.depth, depth);
    if (static_cast<double>(-area_) >= large_) seen_.depth_of_large = std::max(seen_.depth_of_large, depth);
    for (int c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < 3; ++i)
        values[i] = static_cast<Quad>(screen_[i].normal[c]) * static_cast<double>(set_up::normal_unit(format_));
      seen_.normal = std::max(seen_.normal, off(words_.normals[static_cast<std::size_t>(c)], s, exact(values)));
    }
  }

  // Sums wrap, and the error does not.
  double off(const object_processor::LinearWords& words, const Sample& s, Quad exact) const {
    const std::uint32_t word = word_.at(words, static_cast<std::uint32_t>(s.x), static_cast<std::uint32_t>(s.y));
    const Quad range = static_cast<double>(std::uint64_t{1} << word_.bits());
    Quad error = static_cast<Quad>(word) - exact;
    while (error > range / 2) error -= range;
    while (error < -range / 2) error += range;
    return std::fabs(static_cast<double>(error));
  }

  void look_at_edge(const Sample& s, std::size_t e, std::int64_t value) {
    ++seen_.tests;
    const SnappedPoint &from = corners_[e], &to = corners_[(e + 1) % 3];
    const std::uint32_t word =
        word_.at(words_.edges[e], static_cast<std::uint32_t>(s.x), static_cast<std::uint32_t>(s.y));
    const bool covered = (word >> (word_.bits() - 1)) == 0;
    const bool top_left = to.y > from.y || (to.y == from.y && to.x < from.x);
    if (covered == (value > 0 || (value == 0 && top_left))) return;
    if (format_.edges == set_up::EdgeForm::snapped) {
      seen_.wrong += 1.0;
      return;
    }
    // The sign of an edge is that of the sample's distance; a sample on the edge belongs to either.
    const double length = std::hypot(static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y));
    if (value != 0)
      seen_.displaced = std::max(seen_.displaced, std::ldexp(std::fabs(static_cast<double>(value)) / length, -q_));
  }

  const set_up::WordFormat& format_;
  const geometry::SnapGrids& grids_;
  Numbers& numbers_;
  double large_;
  object_processor::WordFormat word_;
  int q_ = 0;
  std::array<SnappedPoint, 3> corners_{};
  set_up::ScreenTriangle<double> screen_{};
  std::int64_t area_ = 0;
  object_processor::TriangleWords words_;
  PlaneSeen seen_;
};

}  // namespace

PlaneSeen search_planes(const set_up::WordFormat& format, const geometry::SnapGrids& grids, Numbers& numbers,
                        std::int64_t triangles, double large) {
  PlaneSearch search(format, grids, numbers, large);
  for (std::int64_t i = 0; i < triangles; ++i) search.triangle(static_cast<PlaneFamily>(i % 4));
  return search.seen();
}

}  // namespace rastertlm::analysis
