#include "src/reference/piece_light.h"

#include <algorithm>
#include <span>

#include "src/base/errors.h"
#include "src/reference/shine_observer.h"

namespace rastertlm::reference {
namespace {

using geometry::LightSource;

constexpr double kFullScale = 255.0;

glm::dvec3 interpolated(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        const std::array<double, 2>& weights) {
  return a + weights[0] * (b - a) + weights[1] * (c - a);
}

// Weights that are linear on the screen, made linear on the surface: each times 1/w of its corner.
std::array<double, 2> on_surface(const Piece& piece, const std::array<double, 2>& weights) {
  const double first = (1.0 - weights[0] - weights[1]) * piece.corners[0].inverse_w;
  const double second = weights[0] * piece.corners[1].inverse_w;
  const double third = weights[1] * piece.corners[2].inverse_w;
  const double sum = first + second + third;
  return {second / sum, third / sum};
}

}  // namespace

PieceLight::PieceLight(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options)
    : kind_(options.kind) {
  rules_ = {scene.model == scene::LightingModel::phong ? geometry::Model::phong : geometry::Model::blinn,
            scene.specular_gate, scene.ambient_light};
  viewer_at_eye_ = kind_ == Reference::true_model && scene.camera.projection == scene::ProjectionKind::perspective;
  for (const scene::Material& m : scene.materials)
    surfaces_.push_back({m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent});
  for (const scene::Light& light : pose.lights) {
    const bool at_point = light.kind == scene::LightKind::point;
    any_at_point_ = any_at_point_ || at_point;
    if (at_point && kind_ != Reference::true_model && !options.lights_at_points)
      throw InputError(Diagnostic{"", 0, "light.type",
                                  "a light at a point is not in the machine's model; only the true reference has it"});
    const double mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3.0;
    lights_.push_back(
        {at_point, light.vector, light.intensity, options.specular_mean ? glm::dvec3(mean) : light.intensity});
  }
}

glm::dvec3 PieceLight::normal_at(const Piece& piece, const std::array<double, 2>& weights) {
  const auto& [a, b, c] = piece.corners;
  return interpolated(a.normal, b.normal, c.normal, weights);
}

glm::dvec3 PieceLight::levels(const Piece& piece, const std::array<double, 2>& on_screen) const {
  float specular = 0.0F;
  return levels(piece, on_screen, specular);
}

glm::dvec3 PieceLight::levels(const Piece& piece, const std::array<double, 2>& on_screen, float& specular) const {
  glm::dvec3 position(0.0);
  std::array<double, 2> weights = on_screen;
  if (kind_ == Reference::true_model) weights = on_surface(piece, on_screen);
  if (kind_ == Reference::true_model || any_at_point_)
    position = interpolated(piece.eye_positions[0], piece.eye_positions[1], piece.eye_positions[2], weights);
  return levels(piece.material, normal_at(piece, weights), position, specular);
}

glm::dvec3 PieceLight::levels(std::uint16_t material, const glm::dvec3& normal, const glm::dvec3& position,
                              float& specular) const {
  const glm::dvec3 viewer = viewer_at_eye_ ? geometry::normalised<double>(-position) : glm::dvec3(0.0, 0.0, 1.0);
  glm::dvec3 shine(0.0);
  const glm::dvec3 light =
      geometry::illumination<double>(surfaces_[material], std::span<const LightSource>(lights_), rules_,
                                     geometry::normalised<double>(normal), viewer, position, ShineObserver{shine});
  specular = largest_level(shine);
  return {std::clamp(kFullScale * light.x, 0.0, kFullScale), std::clamp(kFullScale * light.y, 0.0, kFullScale),
          std::clamp(kFullScale * light.z, 0.0, kFullScale)};
}

}  // namespace rastertlm::reference
