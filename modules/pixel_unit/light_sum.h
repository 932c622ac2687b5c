// The lighting equation from cosines: what all methods of the unit have in common. The same equation as
// geometry::illumination, from which they differ in how they come by the cosines.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "modules/pixel_unit/attribute_plane.h"
#include "src/geometry/lighting.h"

namespace rastertlm::pixel_unit {

// Of a pixel and a light: N.L, and N.H (Blinn) or R.V (Phong).
template <class T>
struct Cosines {
  T light;
  T highlight;
};

// What a surface makes of a light, a channel.
struct LightOnSurface {
  glm::dvec3 diffuse{0.0};
  glm::dvec3 specular{0.0};
};

struct LitSurface {
  glm::dvec3 ambient{0.0};
  std::vector<LightOnSurface> lights;
  int exponent = 1;
  bool specular_gate = false;  // no specular where N.L <= 0
};

inline LitSurface lit_surface(const geometry::Reflectance& surface, const std::vector<geometry::LightSource>& lights,
                              const geometry::LightingRules& rules) {
  LitSurface lit;
  lit.ambient = surface.ambient * rules.ambient_light;
  lit.exponent = surface.exponent;
  lit.specular_gate = rules.specular_gate;
  for (const geometry::LightSource& light : lights)
    lit.lights.push_back({surface.diffuse * light.diffuse_intensity, surface.specular * light.specular_intensity});
  return lit;
}

// 1 is full scale, not clamped.
template <class T>
Vector3<T> light_sum(const LitSurface& surface, const std::vector<Cosines<T>>& cosines) {
  Vector3<T> sum = vector_of<T>(surface.ambient);
  for (std::size_t l = 0; l < surface.lights.size(); ++l) {
    const LightOnSurface& light = surface.lights[l];
    const bool lit = cosines[l].light > T(0.0);
    const bool shines = cosines[l].highlight > T(0.0) && (lit || !surface.specular_gate);
    if (lit) sum = sum + scaled(vector_of<T>(light.diffuse), cosines[l].light);
    if (!shines) continue;
    const T power = geometry::integer_power(cosines[l].highlight, surface.exponent);
    sum = sum + scaled(vector_of<T>(light.specular), power);
  }
  return sum;
}

// Lights and viewer as one point of a triangle sees them: unit vectors.
template <class T>
struct SeenLights {
  std::vector<Vector3<T>> towards;    // a light
  std::vector<Vector3<T>> highlight;  // Blinn: H, a light; Phong: the viewer alone
  std::vector<T> light_viewer;        // Phong: L.V, a light
};

template <class T>
void see_lights(const std::vector<geometry::LightSource>& lights, geometry::Model model, const Vector3<T>& position,
                const Vector3<T>& viewer, SeenLights<T>& seen) {
  seen.towards.clear();
  seen.highlight.clear();
  seen.light_viewer.clear();
  if (model == geometry::Model::phong) seen.highlight.push_back(viewer);
  for (const geometry::LightSource& light : lights) {
    Vector3<T> towards = vector_of<T>(light.vector);
    if (light.at_point) towards = geometry::normalised<T>(towards - position);
    seen.towards.push_back(towards);
    if (model == geometry::Model::blinn)
      seen.highlight.push_back(geometry::normalised<T>(towards + viewer));
    else
      seen.light_viewer.push_back(geometry::dot(towards, viewer));
  }
}

// Cosines from a pixel's dot products, those with `towards` and then those with `highlight`: R.V = 2 (N.L) (N.V) - L.V.
// Without a normal all are zero.
template <class T>
void cosines_from(const std::vector<T>& dots, const SeenLights<T>& seen, bool has_normal,
                  std::vector<Cosines<T>>& cosines) {
  const std::size_t lights = seen.towards.size();
  for (std::size_t l = 0; l < lights; ++l) {
    cosines[l] = {T(0.0), T(0.0)};
    if (!has_normal) continue;
    cosines[l].light = dots[l];
    if (seen.light_viewer.empty())
      cosines[l].highlight = dots[lights + l];
    else
      cosines[l].highlight = T(2.0) * dots[l] * dots[lights] - seen.light_viewer[l];
  }
}

}  // namespace rastertlm::pixel_unit
