// The light that leaves a point of a piece, as a reference has it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "src/geometry/lighting.h"
#include "src/reference/pieces.h"
#include "src/reference/renderer.h"

namespace rastertlm::reference {

class PieceLight {
 public:
  // Throws InputError for a light at a point where the model has none.
  PieceLight(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options);

  // Levels 0..255, clamped and not rounded. `on_screen`: weights of the second and third corner where the point is
  // seen; they may lie outside the piece.
  glm::dvec3 levels(const Piece& piece, const std::array<double, 2>& on_screen) const;
  // The same; `specular` takes the largest of the levels that specular light adds to a channel.
  glm::dvec3 levels(const Piece& piece, const std::array<double, 2>& on_screen, float& specular) const;

  // Of any point: `normal` outwards, of any length, and `position` in eye space.
  glm::dvec3 levels(std::uint16_t material, const glm::dvec3& normal, const glm::dvec3& position,
                    float& specular) const;

  // What the equation is given; `normal` of piece at those weights is not of unit length.
  static glm::dvec3 normal_at(const Piece& piece, const std::array<double, 2>& weights);
  const std::vector<geometry::Reflectance>& surfaces() const { return surfaces_; }  // by material
  const std::vector<geometry::LightSource>& lights() const { return lights_; }
  const geometry::LightingRules& rules() const { return rules_; }

 private:
  Reference kind_;
  geometry::LightingRules rules_;
  bool viewer_at_eye_ = false;
  bool any_at_point_ = false;
  std::vector<geometry::Reflectance> surfaces_;
  std::vector<geometry::LightSource> lights_;
};

}  // namespace rastertlm::reference
