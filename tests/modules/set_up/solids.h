// Random solids of all kinds before an eye, for tests of quadrics.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <random>
#include <vector>

#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

struct SolidShape {
  const char* name;
  glm::dvec4 diagonal;  // of x^2, y^2, z^2, 1
  double z_linear;      // 2 of them in the matrix
  bool capped;          // between z = -1 and z = 1
};
inline constexpr std::array<SolidShape, 8> kSolidShapes{{
    {"sphere", {1, 1, 1, -1}, 0, false},
    {"ellipsoid", {1, 4, 9, -1}, 0, false},
    {"half ellipsoid", {1, 2, 1, -2}, 0, true},
    {"cylinder", {1, 1, 0, -1}, 0, true},
    {"cone", {1, 1, -1, 0}, 0, true},
    {"paraboloid", {1, 1, 0, -1}, 0.5, true},
    {"hyperboloid of one sheet", {1, 1, -1, -0.2}, 0, true},
    {"hyperboloid of two sheets", {1, 1, -1, 0.2}, 0, true},
}};

struct View {
  geometry::Viewport viewport;
  glm::dmat4 screen_to_eye{1.0};
};

// Eight wide at the distance 6 of the middle of things, near 1, far 20.
inline View view_of(bool perspective, const geometry::Viewport& viewport) {
  const double ratio = static_cast<double>(viewport.lines) / static_cast<double>(viewport.columns);
  const glm::dmat4 clip = perspective
                              ? glm::frustumRH_ZO(-4.0 / 6, 4.0 / 6, -4.0 / 6 * ratio, 4.0 / 6 * ratio, 1.0, 20.0)
                              : glm::orthoRH_ZO(-4.0, 4.0, -4.0 * ratio, 4.0 * ratio, 1.0, 20.0);
  return {viewport, glm::inverse(geometry::eye_to_screen(clip, viewport))};
}

struct PlacedSolid {  // in eye space
  glm::dmat4 quadric{1.0};
  std::vector<glm::dvec4> planes;
};

inline PlacedSolid placed_solid(const SolidShape& shape, const glm::dmat4& to_eye) {
  glm::dmat4 q(0.0);
  for (int i = 0; i < 4; ++i) q[i][i] = shape.diagonal[i];
  q[2][3] = q[3][2] = shape.z_linear;
  PlacedSolid solid{geometry::quadric_in_eye_space(q, to_eye), {}};
  if (shape.capped) {
    const glm::dmat4 back = glm::transpose(glm::inverse(to_eye));
    solid.planes = {back * glm::dvec4(0, 0, 1, -1), back * glm::dvec4(0, 0, -1, -1)};
  }
  return solid;
}

inline glm::dmat4 random_place(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
  };
  const double size = std::exp2(uniform(-3, 1.5));
  glm::dmat4 to_eye = glm::translate(glm::dmat4(1.0), glm::dvec3(uniform(-4, 4), uniform(-3, 3), uniform(-12, -2)));
  to_eye =
      glm::rotate(to_eye, uniform(0, 6), glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))));
  return glm::scale(to_eye, size * glm::dvec3(uniform(0.5, 2), uniform(0.5, 2), uniform(0.5, 2)));
}

}  // namespace rastertlm::set_up
