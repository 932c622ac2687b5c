// Which of several triangles is seen: where their depths are equal, and where their planes cross. The derivations stand
// in configs/hard_cases/depth_ties.toml and depth_crossing.toml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/order_screen.h"
#include "src/analysis/random_triangles.h"

namespace rastertlm::analysis {
namespace {

using set_up::ScreenTriangle;

enum class Planes { equal, crossing };
constexpr std::size_t kEqual = 5;  // triangles in one place

// Depths about the middle, of a spread from all of the range to a few units of its word.
ScreenTriangle<double> with_depths(const Corners& corners, Numbers& numbers) {
  const double spread = std::ldexp(0.5, -static_cast<int>(numbers.whole(0, 20)));
  ScreenTriangle<double> triangle{};
  for (std::size_t i = 0; i < 3; ++i)
    triangle[i] = {corners[i].x, corners[i].y, 0.5 + numbers.uniform(-spread, spread), 1.0, {0.0, 0.0, 1.0}};
  return triangle;
}

class Bench {
 public:
  explicit Bench(Trial& trial)
      : numbers_(trial.numbers),
        screen_(TriangleScreen::of(trial)),
        order_(OrderScreen::of(trial)),
        grid_(TriangleShape{}.grid_of(*screen_)),
        pixels_(screen_->viewport().columns * screen_->viewport().lines) {}

  // One triangle on several processors: the lowest number is seen.
  void ties() {
    const ScreenTriangle<double> triangle = any();
    if (!has_area(triangle)) return;
    order_->show(std::vector(kEqual, triangle), grid_, [&](std::int64_t, std::int64_t, std::size_t seen) {
      ++compared;
      wrong += seen != 0 ? 1 : 0;
    });
  }

  // Two of any planes: where the further is seen, they are apart by no more than their errors.
  void crossing() {
    const std::array<ScreenTriangle<double>, 2> pair{any(), any()};
    if (!has_area(pair[0]) || !has_area(pair[1])) return;
    const std::array<SnappedPlane, 2> planes{plane_of(pair[0]), plane_of(pair[1])};
    for (std::uint8_t& covered : pixels_) covered = 0;
    bool promised = true;
    for (std::size_t i = 0; i < 2; ++i)
      screen_->draw(pair[i], grid_, [&](std::int64_t x, std::int64_t y, double depth) {
        pixels_[index(x, y)] |= static_cast<std::uint8_t>(1U << i);
        promised = promised && !std::isnan(depth);
      });
    if (!promised) return;
    order_->show({pair[0], pair[1]}, grid_, [&](std::int64_t x, std::int64_t y, std::size_t seen) {
      constexpr std::uint8_t kBoth = 3;
      if (pixels_[index(x, y)] != kBoth) return;
      ++compared;
      const auto behind = static_cast<double>(planes[seen].at(x, y) - planes[1 - seen].at(x, y));
      const double most =
          screen_->plane_bound(planes[0], x, y) + screen_->plane_bound(planes[1], x, y) + order_->fraction();
      keep_worst(apart, std::max(behind, 0.0), most);
      wrong += behind > 0 ? 1 : 0;
    });
  }

  std::int64_t compared = 0;  // pixels
  std::int64_t wrong = 0;
  Measurement apart{"", "units", 0.0, 0.0, BoundKind::proved};

 private:
  ScreenTriangle<double> any() {
    const Corners corners = random_corners({}, *screen_, grid_, numbers_);
    return with_depths(corners, numbers_);
  }
  SnappedPlane plane_of(const ScreenTriangle<double>& triangle) const {
    return depth_plane(triangle, screen_->plane_bits(grid_), screen_->depth_format());
  }
  bool has_area(const ScreenTriangle<double>& triangle) const {
    std::array<geometry::SnappedPoint, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = geometry::snap(triangle[i], screen_->plane_bits(grid_));
    return geometry::doubled_area(points[0], points[1], points[2]) != 0;
  }
  std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y) * screen_->viewport().columns + static_cast<std::size_t>(x);
  }

  Numbers& numbers_;
  std::unique_ptr<TriangleScreen> screen_;
  std::unique_ptr<OrderScreen> order_;
  geometry::SnapGrid grid_;
  std::vector<std::uint8_t> pixels_;  // a bit for each triangle of a pair that covers it
};

class DepthOrderCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    table.choice("planes", planes_, {"equal", "crossing"}, {"", "Of the triangles.", "the catalogue's figures"});
  }
  std::string step(const run::Inputs::Content& machine) const override {
    return std::holds_alternative<imogene::Machine>(machine.machine) ? "decision_unit.topology"
                                                                     : "frame_store.depth_test";
  }

  double try_us(const run::Inputs::Content& /*machine*/) const override { return 2000.0; }
  Measured measure(Trial& trial) const override {
    const std::int64_t tries = trial.tries_or(tries_);
    Bench bench(trial);
    for (std::int64_t round = 0; round < tries; ++round) planes_ == Planes::equal ? bench.ties() : bench.crossing();
    if (planes_ == Planes::equal)
      return {{{fmt::format("{} comparisons of {} equal depths", bench.compared, kEqual), "pixels",
                static_cast<double>(bench.wrong), 0.0, BoundKind::proved}},
              {}};
    bench.apart.what = fmt::format("depth between two of which the further is seen, {} of {} comparisons", bench.wrong,
                                   bench.compared);
    return {{bench.apart}, {}};
  }

 private:
  std::int64_t tries_ = 30;
  Planes planes_ = Planes::equal;
};

}  // namespace

std::unique_ptr<CaseKind> depth_order_case() { return std::make_unique<DepthOrderCase>(); }

}  // namespace rastertlm::analysis
