// Quadrilaterals in space through the host's projection, clipping and set-up to pixels and depths, against the same
// without rounding or clipping. The derivation stands in configs/hard_cases/view_partly_off.toml.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "modules/host/path_counts.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/projected_quad.h"
#include "src/analysis/triangle_screen.h"
#include "src/base/mathematics.h"
#include "src/scene/transform.h"

namespace rastertlm::analysis {
namespace {

enum class Projection { perspective, orthographic };

struct View {
  Projection projection = Projection::perspective;
  double fov_deg = 45.0;       // vertical
  double size_pixels = 300.0;  // from the middle of a quadrilateral to a corner, as seen
  double spread_pixels = 256;  // from the middle of the screen to a point of a quadrilateral, along each axis
  double nearest = 1.5;        // of corners, in distances of the near plane; behind the eye where negative
  double furthest = 50.0;
};
constexpr double kFar = 100.0;  // in distances of the near plane

constexpr double kNear = 0.5;

glm::dmat4 eye_to_clip(const View& view, const geometry::Viewport& screen) {
  const double aspect = static_cast<double>(screen.columns) / static_cast<double>(screen.lines);
  if (view.projection == Projection::perspective) return scene::perspective(view.fov_deg, aspect, kNear, kFar * kNear);
  return scene::orthographic(2 * kNear * aspect, 2 * kNear, kNear, kFar * kNear);
}

// The entries that see, against the closed form in 113 bits, in ulps of each.
double matrix_error(const View& view, const geometry::Viewport& screen, const glm::dmat4& shown) {
  const Quad aspect = static_cast<Quad>(static_cast<double>(screen.columns)) / static_cast<double>(screen.lines);
  const Quad near = kNear, far = kFar * near, depth = far - near;
  const bool sees_far = view.projection == Projection::perspective;
  const Quad half =
      sees_far ? sine_deg(static_cast<Quad>(view.fov_deg) / 2) / cosine_deg(static_cast<Quad>(view.fov_deg) / 2) : near;
  double worst = 0.0;
  const auto compare = [&](double entry, Quad right) {
    worst = std::max(worst, to_double(absolute((entry - right) / right)) / std::numeric_limits<double>::epsilon());
  };
  compare(shown[0][0], 1 / (aspect * half));
  compare(shown[1][1], 1 / half);
  compare(shown[2][2], sees_far ? -far / depth : -1 / depth);
  compare(shown[3][2], sees_far ? -far * near / depth : -near / depth);
  return worst;
}

glm::dvec3 any_axis(Numbers& numbers) {
  return {numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(0.1, 1)};
}

// Corners in pixels from the middle of the screen, counter-clockwise. A point of a side, of the common edge, or the
// middle of all is near the middle of the screen: however large it is, something of it is seen.
std::array<glm::dvec2, 4> around_middle(const View& view, Numbers& numbers) {
  std::array<glm::dvec2, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double angle = 90.0 * static_cast<double>(i) + numbers.uniform(5, 85);
    const double size = view.size_pixels * numbers.uniform(0.5, 1.0);
    corners[i] = {size * mathematics::cos_deg(angle), size * mathematics::sin_deg(angle)};
  }
  const auto side = static_cast<std::size_t>(numbers.whole(0, 5));
  const double part = numbers.uniform(0, 1);
  glm::dvec2 seen(0.0);
  if (side < 4) seen = (1 - part) * corners[side] + part * corners[(side + 1) % 4];
  if (side == 4) seen = (1 - part) * corners[0] + part * corners[2];
  const glm::dvec2 at(numbers.uniform(-view.spread_pixels, view.spread_pixels),
                      numbers.uniform(-view.spread_pixels, view.spread_pixels));
  for (glm::dvec2& corner : corners) corner += at - seen;
  return corners;
}

// Seen there, at depths of their own.
SpaceQuad random_quad(const View& view, const geometry::Viewport& screen, Numbers& numbers) {
  SpaceQuad quad;
  const glm::dmat4 projection = eye_to_clip(view, screen);
  glm::dmat4 object_to_eye = scene::rotation_deg(any_axis(numbers), numbers.uniform(-180, 180));
  object_to_eye[3] = glm::dvec4(numbers.uniform(-3, 3), numbers.uniform(-3, 3), numbers.uniform(-9, -1), 1.0);
  quad.object_to_clip = host::matrix_product<double>(projection, object_to_eye);
  const glm::dmat4 eye_to_object = glm::inverse(object_to_eye);
  std::array<glm::dvec2, 4> seen = around_middle(view, numbers);
  for (std::size_t i = 0; i < 4; ++i) {
    const double depth = kNear * numbers.uniform(view.nearest, view.furthest);
    // A pixel in eye space, at distance 1 or anywhere.
    const double x = 2.0 / static_cast<double>(screen.columns) / projection[0][0];
    const double y = 2.0 / static_cast<double>(screen.lines) / projection[1][1];
    const double away = view.projection == Projection::perspective ? std::fabs(depth) : 1.0;
    quad.corners[i] = glm::dvec3(eye_to_object * glm::dvec4(x * away * seen[i].x, y * away * seen[i].y, -depth, 1.0));
  }
  return quad;
}

class Bench {
 public:
  Bench(TriangleScreen& screen, const Tampering& tampering)
      : screen_(screen), tampering_(tampering), count_(screen.viewport().columns * screen.viewport().lines) {}

  void measure(const SpaceQuad& quad) {
    const ProjectedQuad at = project(quad, screen_, tampering_);
    keep_worst(positions, at.position_error, at.position_bound);
    if (at.common_edge_is_seen) ++common_edges;
    if (at.common_edge_is_seen && at.common_corners < 2) unlike += 1;
    double moved = 0.0;
    for (std::size_t t = 0; t < 2; ++t)
      for (const auto& piece : at.pieces[t].list()) {
        moved = std::max(moved, screen_.displacement(piece, at.grid));
        draw(piece, at, at.exact[t]);
      }
    compare(at, moved + std::sqrt(2.0) * at.most_moved);
    for (const std::size_t pixel : drawn_) count_[pixel] = 0;
    drawn_.clear();
  }

  Measurement positions{"corner of a piece, as projected and clipped", "pixels", 0.0, 0.0, BoundKind::proved};
  Measurement pixels{"", "pixels off", 0.0, 0.0, BoundKind::proved};
  Measurement depths{"depth of a pixel", "units", 0.0, 0.0, BoundKind::proved};
  double unlike = 0.0;  // common edges whose corners differ from one triangle to the other
  std::int64_t common_edges = 0;
  std::int64_t covered = 0;
  std::int64_t pieces = 0;

 private:
  void draw(const set_up::ScreenTriangle<double>& piece, const ProjectedQuad& at, const ExactTriangle& exact) {
    ++pieces;
    const int bits = screen_.plane_bits(at.grid);
    std::array<geometry::SnappedPoint, 3> points;
    for (std::size_t i = 0; i < 3; ++i) points[i] = geometry::snap(piece[i], bits);
    if (geometry::doubled_area(points[0], points[1], points[2]) == 0) return;
    const SnappedPlane plane = depth_plane(piece, bits, screen_.depth_format());
    const double nearest = static_cast<double>(set_up::near_depth(screen_.depth_format()));
    const double range = static_cast<double>(set_up::far_depth(screen_.depth_format())) - nearest;
    // What a corner's move onto the grid, and its own error, make of the plane.
    const double step = std::ldexp(0.5, -bits) + at.most_moved;
    const double places = 8 * kExtendedPlace *
                          (exact.depth_slope(0) * static_cast<double>(screen_.viewport().columns) +
                           exact.depth_slope(1) * static_cast<double>(screen_.viewport().lines) + 1);
    const double shifted =
        range * (places + step * (exact.depth_slope(0) + exact.depth_slope(1)) + at.depth_moved) * (1 + 1e-9);
    seen_.clear();
    const int sign = screen_.draw(piece, at.grid, [&](std::int64_t x, std::int64_t y, double depth) {
      seen_.push_back(static_cast<std::size_t>(y) * screen_.viewport().columns + static_cast<std::size_t>(x));
      if (std::isnan(depth)) return;  // nothing is promised of it
      const Extended right = range * exact.depth(static_cast<Extended>(x), static_cast<Extended>(y)) + nearest;
      keep_worst(depths, std::fabs(static_cast<double>(depth - right)), screen_.plane_bound(plane, x, y) + shifted);
    });
    for (const std::size_t pixel : seen_) count_[pixel] += sign;
    drawn_.insert(drawn_.end(), seen_.begin(), seen_.end());
    covered += static_cast<std::int64_t>(seen_.size());
  }

  void compare(const ProjectedQuad& at, double most) {
    keep_worst(pixels, 0.0, most);
    const auto columns = screen_.viewport().columns;
    double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
    for (const auto& side : at.outline) {
      left = std::min(left, to_double(side[0].x));
      right = std::max(right, to_double(side[0].x));
      top = std::min(top, to_double(side[0].y));
      bottom = std::max(bottom, to_double(side[0].y));
    }
    const auto clamped = [](double value, std::size_t last) {
      return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(last)));
    };
    for (std::size_t y = clamped(top - 2, screen_.viewport().lines); y < clamped(bottom + 3, screen_.viewport().lines);
         ++y)
      for (std::size_t x = clamped(left - 2, columns); x < clamped(right + 3, columns); ++x) {
        const auto px = static_cast<double>(x), py = static_cast<double>(y);
        const int shown = count_[y * columns + x];
        if (shown == at.exact[0].count(px, py) + at.exact[1].count(px, py)) continue;
        if (shown == at.exact[0].count_exactly(px, py) + at.exact[1].count_exactly(px, py)) continue;
        keep_worst(pixels, at.distance_from_outline(px, py), most);
      }
  }

  TriangleScreen& screen_;
  const Tampering& tampering_;
  std::vector<int> count_;
  std::vector<std::size_t> seen_;   // of a piece
  std::vector<std::size_t> drawn_;  // of the quadrilateral
};

class ProjectionCase : public CaseKind {
 public:
  void declare(parameter::Table& table) override {
    const std::string moves = "the catalogue's figures";
    table.integer("tries", tries_, {1, 100'000'000}, {"", "Random inputs.", moves});
    table.choice("projection", view_.projection, {"perspective", "orthographic"}, {"", "How the eye sees.", moves});
    table.real("fov_deg", view_.fov_deg, {0.0, 180.0, true},
               {"degrees", "Vertical field of view, perspective.", moves});
    table.real("size_pixels", view_.size_pixels, {1e-6, 1e9},
               {"pixels", "From the middle of a quadrilateral to its corners, at most.", moves});
    table.real(
        "spread_pixels", view_.spread_pixels, {0.0, 1e9},
        {"pixels", "From the middle of the screen to a point of a quadrilateral, along each axis, at most.", moves});
    table.real(
        "nearest", view_.nearest, {-1000.0, 1000.0},
        {"", "Distance of the nearest corners by that of the near plane; behind the eye where negative.", moves});
    table.real("furthest", view_.furthest, {-1000.0, 1000.0},
               {"", "The same of the furthest; the far plane is at 100.", moves});
  }
  void check(const std::string& file, Diagnostics& diagnostics) const override {
    if (view_.nearest > view_.furthest) diagnostics.add({file, 0, "nearest", "is beyond furthest"});
    if (view_.fov_deg >= 180.0) diagnostics.add({file, 0, "fov_deg", "must be below 180 degrees"});
  }
  std::string step(const run::Inputs::Content& machine) const override { return coverage_step(machine); }
  double try_us(const run::Inputs::Content& /*machine*/) const override {
    return view_.size_pixels < 1.0 ? 16.0 : 5000.0;  // nothing, or most of the screen
  }

  Measured measure(Trial& trial) const override {
    const auto screen = TriangleScreen::of(trial);
    const std::int64_t tries = trial.tries_or(tries_);
    Bench bench(*screen, trial.tampering);
    for (std::int64_t round = 0; round < tries; ++round)
      bench.measure(random_quad(view_, screen->viewport(), trial.numbers));
    bench.pixels.what =
        fmt::format("pixel furthest from the outline, of {} that {} pieces cover", bench.covered, bench.pieces);
    glm::dmat4 matrix = eye_to_clip(view_, screen->viewport());
    if (trial.tampering.projection) trial.tampering.projection(matrix);
    constexpr double kMostUlps = 4.0;
    Measured found{{{"entry of the projection's matrix", "ulps", matrix_error(view_, screen->viewport(), matrix),
                     kMostUlps, BoundKind::required},
                    bench.positions,
                    bench.pixels},
                   {}};
    if (bench.covered > 0) found.measurements.push_back(bench.depths);
    found.measurements.push_back({fmt::format("corners on {} common edges that are not the same", bench.common_edges),
                                  "edges", bench.unlike, 0.0, BoundKind::proved});
    return found;
  }

 private:
  std::int64_t tries_ = 50;
  View view_;
};

}  // namespace

std::unique_ptr<CaseKind> projection_case() { return std::make_unique<ProjectionCase>(); }

}  // namespace rastertlm::analysis
