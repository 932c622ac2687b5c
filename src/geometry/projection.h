// From eye space to the screen: templates over the number type T (double, float, Counted<double>).
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "src/geometry/counted.h"

namespace rastertlm::geometry {

template <class T>
using Vector3 = glm::vec<3, T, glm::defaultp>;
template <class T>
using Vector4 = glm::vec<4, T, glm::defaultp>;

// A corner of a triangle in clip space (inside: 0 <= z <= w, w > 0), with its eye-space normal and position.
template <class T>
struct ClipVertex {
  Vector4<T> position{};
  Vector3<T> normal{};
};

// A corner on the screen: pixels from the top left (the sample of pixel (i, j) is at (i, j)), z 0 near .. 1 far, linear
// on the screen.
template <class T>
struct ScreenVertex {
  T x{};
  T y{};
  T z{};
  T inverse_w{};  // 1 / w, for perspective-correct interpolation
  Vector3<T> normal{};
};

// matrix * (point, 1): 12 multiplications, 12 additions.
template <class T>
Vector4<T> transform_point(const glm::dmat4& m, const glm::dvec3& p) {
  const auto row = [&](int r) { return T(m[0][r]) * T(p.x) + T(m[1][r]) * T(p.y) + T(m[2][r]) * T(p.z) + T(m[3][r]); };
  return {row(0), row(1), row(2), row(3)};
}

// matrix * vector: 9 multiplications, 6 additions.
template <class T>
Vector3<T> transform_normal(const glm::dmat3& m, const glm::dvec3& n) {
  const auto row = [&](int r) { return T(m[0][r]) * T(n.x) + T(m[1][r]) * T(n.y) + T(m[2][r]) * T(n.z); };
  return {row(0), row(1), row(2)};
}

// The screen of columns x lines pixels. x_pixel = (ndc_x + 1) * columns / 2 - 1/2, y likewise and flipped.
struct Viewport {
  std::size_t columns = 0;
  std::size_t lines = 0;
};

template <class T>
ScreenVertex<T> to_screen(const ClipVertex<T>& vertex, const Viewport& viewport) {
  const double half_columns = static_cast<double>(viewport.columns) / 2;
  const double half_lines = static_cast<double>(viewport.lines) / 2;
  const T inverse_w = T(1.0) / vertex.position.w;
  return {vertex.position.x * inverse_w * T(half_columns) + T(half_columns - 0.5),
          T(half_lines - 0.5) - vertex.position.y * inverse_w * T(half_lines), vertex.position.z * inverse_w, inverse_w,
          vertex.normal};
}

}  // namespace rastertlm::geometry
