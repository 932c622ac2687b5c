#include "src/reference/solids.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace rastertlm::reference {

using geometry::PixelRay;
using geometry::QuadricHit;

PlacedSolid::PlacedSolid(const geometry::Solid& solid, std::uint32_t number, const glm::dmat4& object_to_eye,
                         const glm::dmat4& screen_to_eye)
    : solid_(&solid), number_(number), screen_to_eye_(screen_to_eye) {
  const glm::dmat4 back = glm::inverse(object_to_eye);
  screen_to_solid_ = back * screen_to_eye;
  covector_to_eye_ = glm::dmat3x4(back);
  const glm::dvec4& along = screen_to_solid_[2];
  may_hide_itself_ = glm::dot(along, solid.quadric * along) < 0.0;
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
