// Single triangles, pixel by pixel: exact against the snapped triangle, and near to the triangle that was given.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/random_triangles.h"
#include "src/analysis/triangle_screen.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using geometry::SnapGrid;
using geometry::SnappedPoint;
using set_up::ScreenTriangle;

// Is a sample inside, on the grid and without rounding? A sample on a side is where it would be if it were moved to the
// right by next to nothing, and down by next to nothing of that: the top-left rule. For either orientation.
bool covers(const std::array<SnappedPoint, 3>& p, std::int64_t x, std::int64_t y) {
  int inside = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const SnappedPoint& from = p[i];
    const SnappedPoint& to = p[(i + 1) % 3];
    const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
    std::int64_t side = dx * (y - from.y) - dy * (x - from.x);
    if (side == 0) side = -dy;
    if (side == 0) side = dx;
    inside += side > 0 ? 1 : (side < 0 ? -1 : 0);
  }
  return inside == 3 || inside == -3;
}

// By how much a sample is inside the triangle as it was given: its distance from the nearest of the three lines;
// negative outside, from the line it is furthest beyond. Whichever way round the corners run.
double depth_inside(const Corners& t, double x, double y) {
  const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  double least = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner& from = t[i];
    const Corner& to = t[(i + 1) % 3];
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double side = (dx * (y - from.y) - dy * (x - from.x)) / std::hypot(dx, dy);
    least = std::min(least, area > 0 ? side : -side);
  }
  return least;
}

class Bench {
 public:
  Bench(TriangleScreen& screen, const SnapGrid& grid)
      : screen_(screen), grid_(grid), covered_(screen.viewport().columns * screen.viewport().lines) {}

  void measure(const Corners& corners) {
    ScreenTriangle<double> triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = {corners[i].x, corners[i].y, 0.5, 1.0, {0.0, 0.0, 1.0}};
    drawn_.clear();
    screen_.draw(triangle, grid_, [this](std::int64_t x, std::int64_t y, double /*depth*/) {
      drawn_.push_back(index(x, y));
      covered_[drawn_.back()] = 1;
    });
    compare(corners, triangle);
    for (const std::size_t pixel : drawn_) covered_[pixel] = 0;
    pixels += drawn_.size();
  }

  double wrong = 0.0;  // pixels that are not the snapped triangle's
  Measurement moved{"", "pixels off", 0.0, 0.0, BoundKind::proved};
  std::uint64_t pixels = 0;

 private:
  std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y) * screen_.viewport().columns + static_cast<std::size_t>(x);
  }

  void compare(const Corners& corners, const ScreenTriangle<double>& triangle) {
    const int bits = grid_.fraction_bits;
    std::array<SnappedPoint, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = geometry::snap(triangle[i], bits);
    const double most = screen_.displacement(triangle, grid_);
    keep_worst(moved, 0.0, most);
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto clamped = [](double value, std::size_t last) {
      return static_cast<std::int64_t>(std::clamp(value, 0.0, static_cast<double>(last)));
    };
    const geometry::Viewport view = screen_.viewport();
    for (std::int64_t y = clamped(top - 1, view.lines); y < clamped(bottom + 3, view.lines); ++y)
      for (std::int64_t x = clamped(left - 1, view.columns); x < clamped(right + 3, view.columns); ++x) {
        const bool shown = covered_[index(x, y)] != 0;
        wrong += screen_.is_exact() && shown != covers(points, x << bits, y << bits) ? 1 : 0;
        const double inside = depth_inside(corners, static_cast<double>(x), static_cast<double>(y));
        if (shown != (inside > 0)) keep_worst(moved, std::fabs(inside), most);
      }
  }

  TriangleScreen& screen_;
  SnapGrid grid_;
  std::vector<std::uint8_t> covered_;
  std::vector<std::size_t> drawn_;
};

class TrianglesCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    shape_.declare(table);
  }
  std::string step(const run::Inputs::Content& machine) const override { return coverage_step(machine); }
  double try_us(const run::Inputs::Content& /*machine*/) const override {
    return shape_.family == TriangleFamily::limits ? 5000.0 : 2000.0;
  }

  Measured measure(Trial& trial) const override {
    const auto screen = TriangleScreen::of(trial);
    const std::int64_t tries = trial.tries_or(tries_);
    const SnapGrid grid = shape_.grid_of(*screen);
    Bench bench(*screen, grid);
    for (std::int64_t round = 0; round < tries; ++round)
      bench.measure(random_corners(shape_, *screen, grid, trial.numbers));
    Measured found;
    if (screen->is_exact())
      found.measurements.push_back(
          {fmt::format("{} triangles, {} pixels, against the snapped ones", tries, bench.pixels), "pixels", bench.wrong,
           0.0, BoundKind::proved});
    bench.moved.what = "pixel furthest from the side that should have decided";
    found.measurements.push_back(bench.moved);
    return found;
  }

 private:
  std::int64_t tries_ = 100;
  TriangleShape shape_;
};

}  // namespace

std::unique_ptr<CaseKind> triangles_case() { return std::make_unique<TrianglesCase>(); }

}  // namespace rastertlm::analysis
