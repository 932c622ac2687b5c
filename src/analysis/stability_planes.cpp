// Depth, and the components of the normal, at every pixel of a triangle: beside the plane through its snapped corners,
// without rounding. The derivation stands in configs/hard_cases/planes_well_shaped.toml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/object_processor/line_evaluator.h"
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

// At an end of a range, or anywhere in it.
double limit_or_any(double low, double high, Numbers& numbers) {
  const std::int64_t choice = numbers.whole(0, 3);
  const double any = numbers.uniform(low, high);
  if (choice == 0) return low;
  return choice == 1 ? high : any;
}

// Words are right or wrong modulo their range.
double apart(Extended value, Extended right, double range) {
  const auto off = static_cast<double>(value - right);
  return std::fabs(off - range * std::floor(off / range + 0.5));
}

ScreenTriangle<double> with_values(const Corners& corners, Numbers& numbers) {
  ScreenTriangle<double> triangle{};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle[i] = {corners[i].x, corners[i].y, limit_or_any(0.0, 1.0, numbers), 1.0, {}};
    for (int k = 0; k < 3; ++k) triangle[i].normal[k] = limit_or_any(-1.0, 1.0, numbers);
  }
  return triangle;
}

class Bench {
 public:
  Bench(TriangleScreen& screen, const SnapGrid& grid)
      : screen_(screen), grid_(grid), format_(screen.depth_format()), words_(std::ldexp(1.0, format_.word_bits)) {}

  void measure(const ScreenTriangle<double>& triangle) {
    const int bits = screen_.plane_bits(grid_);
    std::array<SnappedPoint, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = geometry::snap(triangle[i], bits);
    const std::int64_t area = geometry::doubled_area(points[0], points[1], points[2]);
    if (area == 0) return;
    const SnappedPlane plane = depth_plane(triangle, bits, format_);
    covered_.clear();
    screen_.draw(triangle, grid_, [&](std::int64_t x, std::int64_t y, double value) {
      covered_.push_back({x, y});
      if (std::isnan(value)) return;  // nothing is promised of it
      const double most = screen_.plane_bound(plane, x, y);
      keep_worst(depth, apart(value, plane.at(x, y), words_), most);
      loosest = std::max(loosest, most);
      wrapped += std::fabs(static_cast<double>(value - plane.at(x, y))) > words_ / 2 ? 1 : 0;
    });
    pixels += covered_.size();
    measure_normals(triangle, points, geometry::faces_viewer(area));
  }

  Measurement depth{"", "units", 0.0, 0.0, BoundKind::proved};
  Measurement normal{"component of a normal there", "units", 0.0, 0.0, BoundKind::proved};
  double wrapped = 0.0;  // pixels whose depth has passed an end of the word
  double loosest = 0.0;  // the largest bound of a depth
  std::size_t pixels = 0;

 private:
  void measure_normals(const ScreenTriangle<double>& triangle, const std::array<SnappedPoint, 3>& points, bool facing) {
    const auto words = screen_.normal_words(triangle, grid_);
    if (!words) return;
    const auto word_bits = static_cast<unsigned>(format_.word_bits);
    const object_processor::WordFormat format(word_bits);
    const double unit = static_cast<double>(set_up::normal_unit(format_)) * (facing ? 1 : -1);
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> values{};
      for (std::size_t i = 0; i < 3; ++i) values[i] = triangle[i].normal[static_cast<int>(k)] * unit;
      const SnappedPlane plane(points, screen_.plane_bits(grid_), values);
      for (const SnappedPoint& at : covered_) {
        const std::uint32_t word =
            format.at((*words)[k], static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
        const auto value = static_cast<Extended>(sign_extend(word, word_bits));
        keep_worst(normal, apart(value, plane.at(at.x, at.y), words_), screen_.plane_bound(plane, at.x, at.y));
      }
    }
  }

  TriangleScreen& screen_;
  SnapGrid grid_;
  set_up::WordFormat format_;
  double words_;                       // how many a depth has
  std::vector<SnappedPoint> covered_;  // pixels of the triangle
};

class PlanesCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", "the catalogue's figures"});
    shape_.declare(table);
  }
  std::string step(const run::Inputs::Content& machine) const override {
    if (const auto* object = std::get_if<imogene::Machine>(&machine.machine))
      return object->object_processor.edges == set_up::EdgeForm::snapped ? "object_processor.word_bits"
                                                                         : "object_processor.edges";
    const auto* span = span_machine(machine);
    return span->span_unit.start_edge == span_unit::StartEdge::prestep ? "span_unit.start_edge"
                                                                       : "span_unit.depth_fraction_bits";
  }

  double try_us(const run::Inputs::Content& /*machine*/) const override { return 2000.0; }
  Measured measure(Trial& trial) const override {
    const auto screen = TriangleScreen::of(trial);
    const std::int64_t tries = trial.tries_or(tries_);
    const SnapGrid grid = shape_.grid_of(*screen);
    Bench bench(*screen, grid);
    for (std::int64_t round = 0; round < tries; ++round) {
      const Corners corners = random_corners(shape_, *screen, grid, trial.numbers);
      bench.measure(with_values(corners, trial.numbers));
    }
    if (bench.pixels == 0) return {{}, {"no triangle covers a pixel"}};
    bench.depth.what = fmt::format("depth at {} pixels of {} triangles", bench.pixels, tries);
    const auto margin = static_cast<double>(set_up::depth_margin(screen->depth_format()));
    Measured found{{bench.depth}, {}};
    found.measurements.push_back(
        {fmt::format("depths past an end of their word, {} beyond near and far", margin), "pixels", bench.wrapped, 0.0,
         screen->is_exact() && bench.loosest <= margin ? BoundKind::proved : BoundKind::required});
    if (trial.object_machine() != nullptr) found.measurements.push_back(bench.normal);
    return found;
  }

 private:
  std::int64_t tries_ = 100;
  TriangleShape shape_;
};

}  // namespace

std::unique_ptr<CaseKind> planes_case() { return std::make_unique<PlanesCase>(); }

}  // namespace rastertlm::analysis
