#include "src/scene/transform.h"

#include <glm/geometric.hpp>

#include "src/base/mathematics.h"

namespace rastertlm::scene {

glm::dmat4 translation(const glm::dvec3& by) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(by, 1.0);
  return m;
}

glm::dmat4 scaling(const glm::dvec3& factors) {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = factors[i];
  return m;
}

glm::dmat4 rotation_deg(const glm::dvec3& axis, double degrees) {
  const double length = glm::length(axis);
  glm::dmat4 m(1.0);
  if (!(length > 0.0)) return m;
  const glm::dvec3 n = axis / length;
  const double c = mathematics::cos_deg(degrees);
  const double s = mathematics::sin_deg(degrees);
  const glm::dvec3 t = (1.0 - c) * n;
  m[0] = glm::dvec4(c + t.x * n.x, t.x * n.y + s * n.z, t.x * n.z - s * n.y, 0.0);
  m[1] = glm::dvec4(t.y * n.x - s * n.z, c + t.y * n.y, t.y * n.z + s * n.x, 0.0);
  m[2] = glm::dvec4(t.z * n.x + s * n.y, t.z * n.y - s * n.x, c + t.z * n.z, 0.0);
  return m;
}

glm::dmat4 rotation_xyz_deg(const glm::dvec3& degrees) {
  return rotation_deg({0, 0, 1}, degrees.z) * rotation_deg({0, 1, 0}, degrees.y) * rotation_deg({1, 0, 0}, degrees.x);
}

glm::dmat4 about(const glm::dvec3& centre, const glm::dmat4& map) {
  return translation(centre) * map * translation(-centre);
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 side = glm::normalize(glm::cross(forward, up));
  const glm::dvec3 above = glm::cross(side, forward);
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = side[i];
    m[i][1] = above[i];
    m[i][2] = -forward[i];
  }
  m[3] = glm::dvec4(-glm::dot(side, eye), -glm::dot(above, eye), glm::dot(forward, eye), 1.0);
  return m;
}

glm::dmat4 perspective(double vertical_fov_deg, double aspect, double near, double far) {
  const double half = mathematics::tan_deg(0.5 * vertical_fov_deg);
  glm::dmat4 m(0.0);
  m[0][0] = 1.0 / (aspect * half);
  m[1][1] = 1.0 / half;
  m[2][2] = far / (near - far);
  m[2][3] = -1.0;
  m[3][2] = -(far * near) / (far - near);
  return m;
}

glm::dmat4 orthographic(double width, double height, double near, double far) {
  glm::dmat4 m(1.0);
  m[0][0] = 2.0 / width;
  m[1][1] = 2.0 / height;
  m[2][2] = -1.0 / (far - near);
  m[3][2] = -near / (far - near);
  return m;
}

glm::dmat3 inverse_transpose(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return cofactors * (1.0 / glm::dot(m[0], cofactors[0]));
}

}  // namespace rastertlm::scene
