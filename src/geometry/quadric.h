// Quadrics on the screen: solids x^T Q x <= 0, x = (x, y, z, 1), cut by planes, as depth along the ray of each pixel.
// Templates over the number type T (double, float, Counted<double>).
//
// With S = M X from eye space to the screen, Q' = M^-T Q M^-1 and S = (x, y, Z, 1), Z solves
//   a Z^2 + 2 L(x, y) Z + P(x, y) = 0,   a = Q'_33,
// so that Z = l -/+ sqrt(d) with l = -L / a, linear on the screen, and d = (L^2 - a P) / a^2, quadratic. The gradient
// Q M^-1 S is linear in x, y and Z, hence normals are e -/+ k sqrt(d), e linear on the screen: exact, in parallel and
// in perspective projection.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>

#include "src/geometry/projection.h"

namespace rastertlm::geometry {

// x X + y Y + one on pixel (X, Y).
template <class T>
struct LinearForm {
  T x{}, y{}, one{};
  T at(double column, double line) const { return x * T(column) + y * T(line) + one; }
};

template <class T>
struct SecondOrderForm {
  T xx{}, yy{}, xy{}, x{}, y{}, one{};
  T at(double column, double line) const {
    return (xx * T(column) + xy * T(line) + x) * T(column) + (yy * T(line) + y) * T(line) + one;
  }
};

template <class T>
struct ScreenQuadric {
  T a{};                                // of Z^2: more than 0 where the eye is outside; 0: no such form, see below
  LinearForm<T> middle;                 // l
  SecondOrderForm<T> discriminant;      // d
  std::array<LinearForm<T>, 3> normal;  // e: of the surface at Z = l, in eye space, outwards, of no particular length
  std::array<T, 3> normal_of_root{};    // k: at Z = l -/+ s the normal is e -/+ k s
};

// From eye space to pixels and depth: x and y as to_screen, Z = 0 at the near and 1 at the far plane.
inline glm::dmat4 eye_to_screen(const glm::dmat4& eye_to_clip, const Viewport& viewport) {
  const double half_columns = static_cast<double>(viewport.columns) / 2;
  const double half_lines = static_cast<double>(viewport.lines) / 2;
  glm::dmat4 to_pixels(1.0);
  to_pixels[0][0] = half_columns;
  to_pixels[1][1] = -half_lines;
  to_pixels[3][0] = half_columns - 0.5;
  to_pixels[3][1] = half_lines - 0.5;
  return to_pixels * eye_to_clip;
}

// Of a quadric in the space that `to_eye` takes to eye space. The matrix has an inverse.
inline glm::dmat4 quadric_in_eye_space(const glm::dmat4& quadric, const glm::dmat4& to_eye) {
  const glm::dmat4 back = glm::inverse(to_eye);
  return glm::transpose(back) * quadric * back;
}

// `quadric` is symmetric and in eye space; `screen_to_eye` the inverse of eye_to_screen. a = 0 in parallel projection
// along the axis of a cylinder or a paraboloid, or in perspective with the eye on the surface: then nothing else of the
// result means anything.
template <class T>
ScreenQuadric<T> screen_quadric(const glm::dmat4& quadric, const glm::dmat4& screen_to_eye) {
  const auto element = [](const glm::dmat4& m, int row, int column) { return T(m[column][row]); };
  // gradient = Q M^-1, Q' = M^-T gradient.
  std::array<std::array<T, 4>, 4> gradient{}, screen{};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      T sum = element(quadric, row, 0) * element(screen_to_eye, 0, column);
      for (int k = 1; k < 4; ++k) sum = sum + element(quadric, row, k) * element(screen_to_eye, k, column);
      gradient[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = sum;
    }
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = row; column < 4; ++column) {
      T sum = element(screen_to_eye, 0, static_cast<int>(row)) * gradient[0][column];
      for (std::size_t k = 1; k < 4; ++k)
        sum = sum + element(screen_to_eye, static_cast<int>(k), static_cast<int>(row)) * gradient[k][column];
      screen[row][column] = sum;
    }
  ScreenQuadric<T> result;
  result.a = screen[2][2];
  if (!(result.a < T(0.0)) && !(T(0.0) < result.a)) return result;
  const T over_a = T(1.0) / result.a;
  const T lx = screen[0][2] * over_a, ly = screen[1][2] * over_a, lo = screen[2][3] * over_a;  // -l
  result.middle = {-lx, -ly, -lo};
  const T two(2.0);
  result.discriminant = {lx * lx - screen[0][0] * over_a,         ly * ly - screen[1][1] * over_a,
                         two * (lx * ly - screen[0][1] * over_a), two * (lx * lo - screen[0][3] * over_a),
                         two * (ly * lo - screen[1][3] * over_a), lo * lo - screen[3][3] * over_a};
  for (std::size_t i = 0; i < 3; ++i) {
    const T k = gradient[i][2];
    result.normal[i] = {gradient[i][0] - k * lx, gradient[i][1] - k * ly, gradient[i][3] - k * lo};
    result.normal_of_root[i] = k;
  }
  return result;
}

// A plane that cuts: what remains is where dot(plane, (x, y, z, 1)) <= 0. On the screen the depth at which a ray meets
// it, and whether what remains lies beyond; a plane along the rays has no depth, and its form says on which side a
// pixel is.
template <class T>
struct ScreenPlane {
  enum class Keeps { beyond, before, side };
  Keeps keeps = Keeps::side;
  LinearForm<T> depth;  // of `side`: the pixel remains where this is not more than 0
};

template <class T>
ScreenPlane<T> screen_plane(const glm::dvec4& plane, const glm::dmat4& screen_to_eye) {
  std::array<T, 4> c{};  // a row vector times M^-1
  for (int column = 0; column < 4; ++column) {
    T sum = T(plane[0]) * T(screen_to_eye[column][0]);
    for (int k = 1; k < 4; ++k) sum = sum + T(plane[k]) * T(screen_to_eye[column][k]);
    c[static_cast<std::size_t>(column)] = sum;
  }
  if (!(c[2] < T(0.0)) && !(T(0.0) < c[2])) return {ScreenPlane<T>::Keeps::side, {c[0], c[1], c[3]}};
  const T factor = T(-1.0) / c[2];
  return {c[2] < T(0.0) ? ScreenPlane<T>::Keeps::beyond : ScreenPlane<T>::Keeps::before,
          {c[0] * factor, c[1] * factor, c[3] * factor}};
}

// What a ray sees first of a solid.
struct QuadricHit {
  enum class Surface { near_root, far_root, plane, near_plane };
  double depth = 0.0;
  Surface surface = Surface::near_root;
  std::size_t plane = 0;  // which one, where the surface is one
};

// The first depth in 0..1 at which the ray of pixel (column, line) is inside the quadric (a is not 0) and all planes; a
// solid that the near plane cuts shows the cut. Nothing where the ray misses it.
inline std::optional<QuadricHit> first_hit(const ScreenQuadric<double>& quadric,
                                           std::span<const ScreenPlane<double>> planes, double column, double line) {
  using Surface = QuadricHit::Surface;
  using Keeps = ScreenPlane<double>::Keeps;
  QuadricHit first{0.0, Surface::near_plane, 0};
  double last = 1.0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double at = planes[i].depth.at(column, line);
    if (planes[i].keeps == Keeps::side && at > 0.0) return std::nullopt;
    if (planes[i].keeps == Keeps::beyond && at > first.depth) first = {at, Surface::plane, i};
    if (planes[i].keeps == Keeps::before) last = std::min(last, at);
  }
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  const double d = quadric.discriminant.at(column, line);
  if (d < 0.0 && quadric.a > 0.0) return std::nullopt;
  const double s = std::sqrt(std::max(d, 0.0)), l = quadric.middle.at(column, line);
  // Inside from `from` to `to`: between the roots, or before the first and behind the second, or everywhere.
  const auto within = [&](double from, double to, Surface surface) -> std::optional<QuadricHit> {
    const QuadricHit hit = from > first.depth ? QuadricHit{from, surface, 0} : first;
    if (hit.depth > std::min(to, last)) return std::nullopt;
    return hit;
  };
  if (quadric.a > 0.0) return within(l - s, l + s, Surface::near_root);
  if (d < 0.0) return within(-kEnd, kEnd, Surface::near_root);
  if (const auto before = within(-kEnd, l - s, Surface::near_root)) return before;
  return within(l + s, kEnd, Surface::far_root);
}

// Outwards, in eye space, of no particular length: of the quadric's surface at a root.
inline glm::dvec3 quadric_normal(const ScreenQuadric<double>& quadric, QuadricHit::Surface surface, double column,
                                 double line) {
  const double s = std::sqrt(std::max(quadric.discriminant.at(column, line), 0.0));
  const double signed_root = surface == QuadricHit::Surface::far_root ? s : -s;
  glm::dvec3 normal;
  for (std::size_t i = 0; i < 3; ++i)
    normal[static_cast<int>(i)] = quadric.normal[i].at(column, line) + quadric.normal_of_root[i] * signed_root;
  return normal;
}

// The ray of a pixel, in any space that `from_screen` takes the screen to: the point at depth Z is from + Z along,
// homogeneous, with w above 0 at depths in 0..1.
struct PixelRay {
  glm::dvec4 from{0.0};
  glm::dvec4 along{0.0};  // the same for every pixel
  glm::dvec4 at(double depth) const { return from + depth * along; }
};

inline PixelRay pixel_ray(const glm::dmat4& from_screen, double column, double line) {
  return {column * from_screen[0] + line * from_screen[1] + from_screen[3], from_screen[2]};
}

// Where a Z^2 + 2 L Z + P <= 0: between two depths, or outside of them (then one interval ends at the first, another
// begins at the second), or everywhere, or nowhere.
struct DepthIntervals {
  double first = 0.0, second = 0.0;
  bool between = true;
  bool any = true;
};

// Also where `a` is 0 or next to it, and without cancellation in the roots.
inline DepthIntervals depths_inside(double a, double l, double p) {
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  const double d = l * l - a * p;
  if (a == 0.0 && l == 0.0) return {-kEnd, kEnd, true, p <= 0.0};
  if (a == 0.0) return l > 0.0 ? DepthIntervals{-kEnd, -p / (2.0 * l)} : DepthIntervals{-p / (2.0 * l), kEnd};
  if (d < 0.0) return {-kEnd, kEnd, true, a < 0.0};
  const double q = -(l + std::copysign(std::sqrt(d), l));
  const double one = q / a, other = q == 0.0 ? 0.0 : p / q;
  return {std::min(one, other), std::max(one, other), a > 0.0};
}

// The same where the depth half way between the roots is no large number: `value` is the left side there, which a point
// near the surface gives with more digits than L^2 - a P.
inline DepthIntervals depths_about(double a, double middle, double value) {
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  const double square = -value / a;
  if (square < 0.0) return {-kEnd, kEnd, true, a < 0.0};
  return {middle - std::sqrt(square), middle + std::sqrt(square), a > 0.0};
}

inline DepthIntervals depths_inside(const glm::dmat4& quadric, const PixelRay& ray) {
  constexpr double kNear = 4.0;  // beyond the far plane or before the near one, in depth ranges
  const glm::dvec4 to_along = quadric * ray.along;
  const double a = glm::dot(ray.along, to_along), l = glm::dot(ray.from, to_along);
  if (!(std::fabs(l) < kNear * std::fabs(a))) return depths_inside(a, l, glm::dot(ray.from, quadric * ray.from));
  const double middle = -l / a;
  const glm::dvec4 there = ray.at(middle);
  return depths_about(a, middle, glm::dot(there, quadric * there));
}

// first_hit as above, for whoever wants it exact: a solid in the space of the ray, whatever a is.
inline std::optional<QuadricHit> first_hit(const glm::dmat4& quadric, std::span<const glm::dvec4> planes,
                                           const PixelRay& ray) {
  using Surface = QuadricHit::Surface;
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  QuadricHit first{0.0, Surface::near_plane, 0};
  double last = 1.0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const double slope = glm::dot(planes[i], ray.along), start = glm::dot(planes[i], ray.from);
    const double at = -start / slope;
    if (slope == 0.0 && start > 0.0) return std::nullopt;
    if (slope < 0.0 && at > first.depth) first = {at, Surface::plane, i};
    if (slope > 0.0) last = std::min(last, at);
  }
  const DepthIntervals inside = depths_inside(quadric, ray);
  if (!inside.any) return std::nullopt;
  const auto within = [&](double from, double to, Surface surface) -> std::optional<QuadricHit> {
    const QuadricHit hit = from > first.depth ? QuadricHit{from, surface, 0} : first;
    if (hit.depth > std::min(to, last)) return std::nullopt;
    return hit;
  };
  if (inside.between) return within(inside.first, inside.second, Surface::near_root);
  if (const auto before = within(-kEnd, inside.first, Surface::near_root)) return before;
  return within(inside.second, kEnd, Surface::far_root);
}

}  // namespace rastertlm::geometry
