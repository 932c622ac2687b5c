// The solids of a frame: what a pixel's ray sees of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "src/geometry/quadric.h"
#include "src/scene/scene.h"

namespace rastertlm::reference {

class PlacedSolid {
 public:
  // `number`: of the solid among what is drawn, from 1. The solid outlives it.
  PlacedSolid(const geometry::Solid& solid, std::uint32_t number, const glm::dmat4& object_to_eye,
              const glm::dmat4& screen_to_eye);

  std::uint32_t number() const { return number_; }
  std::uint16_t material() const { return solid_->material; }

  // Pixels outside of it do not see the solid: half-open, of the screen's.
  struct Box {
    std::size_t first_column = 0, end_column = 0, first_line = 0, end_line = 0;
  };
  Box box(const geometry::Viewport& viewport) const;

  // What the ray of the pixel sees first, between the near and the far plane. Columns and lines may lie between pixels.
  std::optional<geometry::QuadricHit> hit(double column, double line) const;

  // In eye space: outwards, of no particular length (0 at the tip of a cone), and the point itself. A solid that the
  // near plane cuts shows the cut, which faces the eye.
  struct Point {
    glm::dvec3 normal{0.0};
    glm::dvec3 position{0.0};
  };
  Point point(const geometry::QuadricHit& hit, double column, double line) const;

  // Whether one part of it may hide another: rays may leave it and enter it again.
  bool may_hide_itself() const { return may_hide_itself_; }
  // Whether what is seen at two places jumps on the way from one to the other: by more than `gap` of the depth range,
  // however near the places come. Both see it.
  bool jumps(glm::dvec2 from, glm::dvec2 to, double gap) const;

 private:
  const geometry::Solid* solid_;
  std::uint32_t number_;
  glm::dmat4 screen_to_solid_;
  glm::dmat4 screen_to_eye_;
  glm::dmat3x4 covector_to_eye_;  // of planes and gradients; transposed
  bool may_hide_itself_;
};

// In the order of their numbers; `scene` outlives them.
std::vector<PlacedSolid> placed_solids(const scene::Scene& scene, const scene::Pose& pose,
                                       const geometry::Viewport& viewport);

}  // namespace rastertlm::reference
