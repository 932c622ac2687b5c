#include "src/reference/solids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace rastertlm::reference {

using geometry::QuadricHit;

namespace {

struct Range {
  double low, high;
};

// Where a t^2 + 2 b t + c >= 0, of a < 0; the apex alone where it is nowhere.
Range where_positive(double a, double b, double c) {
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  return {(b - root) / -a, (b + root) / -a};
}

// Of 0..count - 1, with two pixels to spare on either side.
std::pair<std::size_t, std::size_t> pixels_of(const Range& range, std::size_t count) {
  const auto last = static_cast<double>(count);
  return {static_cast<std::size_t>(std::clamp(std::floor(range.low) - 2.0, 0.0, last)),
          static_cast<std::size_t>(std::clamp(std::ceil(range.high) + 3.0, 0.0, last))};
}

}  // namespace

PlacedSolid::PlacedSolid(const geometry::Solid& solid, std::uint32_t number, const glm::dmat4& object_to_eye,
                         const glm::dmat4& screen_to_eye)
    : solid_(&solid), number_(number), screen_to_eye_(screen_to_eye) {
  const glm::dmat4 back = glm::inverse(object_to_eye);
  screen_to_solid_ = back * screen_to_eye;
  covector_to_eye_ = glm::dmat3x4(back);
  const glm::dvec4& along = screen_to_solid_[2];
  may_hide_itself_ = glm::dot(along, solid.quadric * along) < 0.0;
}

// The rays that meet the whole quadric where a > 0: L^2 - a P >= 0, a conic section on the screen. It has a box where
// it is an ellipse, clearly; else all pixels may see the solid.
PlacedSolid::Box PlacedSolid::box(const geometry::Viewport& viewport) const {
  constexpr double kClearly = 1e-6;  // of what a difference is made of
  const Box all{0, viewport.columns, 0, viewport.lines};
  const glm::dmat4 q = glm::transpose(screen_to_solid_) * solid_->quadric * screen_to_solid_;
  const double a = q[2][2];
  const auto conic = [&](int i, int k) { return q[i][2] * q[k][2] - a * q[i][k]; };
  const double xx = conic(0, 0), yy = conic(1, 1), xy = conic(0, 1), x = conic(0, 3), y = conic(1, 3);
  const double one = conic(3, 3), determinant = xx * yy - xy * xy;
  const auto is_clear = [&](int i) { return conic(i, i) < -kClearly * (q[i][2] * q[i][2] + std::fabs(a * q[i][i])); };
  if (!(a > 0.0) || !is_clear(0) || !is_clear(1) || !(determinant > kClearly * xx * yy)) return all;
  const auto columns = pixels_of(where_positive(-determinant, xy * y - yy * x, y * y - yy * one), viewport.columns);
  const auto lines = pixels_of(where_positive(-determinant, xy * x - xx * y, x * x - xx * one), viewport.lines);
  return {columns.first, columns.second, lines.first, lines.second};
}

std::optional<QuadricHit> PlacedSolid::hit(double column, double line) const {
  return geometry::first_hit(solid_->quadric, solid_->planes, geometry::pixel_ray(screen_to_solid_, column, line));
}

PlacedSolid::Point PlacedSolid::point(const QuadricHit& hit, double column, double line) const {
  const glm::dvec4 eye = geometry::pixel_ray(screen_to_eye_, column, line).at(hit.depth);
  const glm::dvec3 position = glm::dvec3(eye) / eye.w;
  if (hit.surface == QuadricHit::Surface::near_plane) return {{0.0, 0.0, 1.0}, position};
  if (hit.surface == QuadricHit::Surface::plane) return {solid_->planes[hit.plane] * covector_to_eye_, position};
  const glm::dvec4 at = geometry::pixel_ray(screen_to_solid_, column, line).at(hit.depth);
  return {(solid_->quadric * at) * covector_to_eye_, position};
}

bool PlacedSolid::jumps(glm::dvec2 from, glm::dvec2 to, double gap) const {
  constexpr int kHalvings = 40;  // a surface that ends upright goes as the root of the distance: 2^-20 is left
  const auto at = [&](const glm::dvec2& place) { return hit(place.x, place.y); };
  std::optional<QuadricHit> here = at(from), there = at(to);
  for (int i = 0; i < kHalvings && here && there; ++i) {
    if (std::fabs(here->depth - there->depth) <= gap) return false;
    const glm::dvec2 middle = 0.5 * (from + to);
    const std::optional<QuadricHit> between = at(middle);
    if (!between) return true;
    if (std::fabs(here->depth - between->depth) > std::fabs(there->depth - between->depth)) {
      to = middle;
      there = between;
    } else {
      from = middle;
      here = between;
    }
  }
  return true;
}

std::vector<PlacedSolid> placed_solids(const scene::Scene& scene, const scene::Pose& pose,
                                       const geometry::Viewport& viewport) {
  const glm::dmat4 screen_to_eye = glm::inverse(geometry::eye_to_screen(pose.eye_to_clip, viewport));
  std::vector<PlacedSolid> solids;
  std::uint32_t number = 0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    number += static_cast<std::uint32_t>(object.mesh.triangles.size());
    if (object.solid) solids.emplace_back(*object.solid, ++number, pose.object_to_eye[o], screen_to_eye);
  }
  return solids;
}

}  // namespace rastertlm::reference
