// Where a solid can be seen on the screen: cheap and never too small. Templates over the number type T.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "modules/set_up/screen_box.h"
#include "src/geometry/counted.h"
#include "src/geometry/quadric.h"

namespace rastertlm::set_up {

// Two planes that face away from each other, p and q, bound the solid: within it p q >= 0, hence Q - f p q <= 0 for
// every f >= 0. With f such that this grows along the planes' normal as it does across it on average, the bounding
// quadric is an ellipsoid for cylinders, cones, paraboloids and hyperboloids between two caps. Nothing where no two
// planes are such, or none is needed.
template <class T>
std::optional<glm::dmat4> bounding_quadric(const glm::dmat4& quadric, std::span<const glm::dvec4> planes) {
  std::size_t first = 0, second = 0;
  T least(0.0);
  const auto dot = [](const glm::dvec4& p, const glm::dvec4& q) {
    return T(p.x) * T(q.x) + T(p.y) * T(q.y) + T(p.z) * T(q.z);
  };
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t k = i + 1; k < planes.size(); ++k)
      if (const T product = dot(planes[i], planes[k]); product < least) {
        least = product;
        first = i;
        second = k;
      }
  if (first == second) return std::nullopt;
  const glm::dvec4 &p = planes[first], &q = planes[second];
  T along(0.0);  // n Q n, n normal of p, of length squared `square`
  for (int row = 0; row < 3; ++row)
    along = along +
            T(p[row]) * (T(quadric[0][row]) * T(p[0]) + T(quadric[1][row]) * T(p[1]) + T(quadric[2][row]) * T(p[2]));
  const T square = dot(p, p);
  const T trace = T(quadric[0][0]) + T(quadric[1][1]) + T(quadric[2][2]);
  // Along n the product p q falls by -least square for a length of sqrt(square).
  const T across = (trace * square - along) * T(0.5);
  if (!(along < across)) return std::nullopt;
  const T factor = (along - across) / (least * square) * T(0.5);
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = row; column < 4; ++column)
      result[column][row] = result[row][column] =
          geometry::plain(T(quadric[column][row]) - factor * (T(p[row]) * T(q[column]) + T(q[row]) * T(p[column])));
  return result;
}

// The box on the screen and the depths between which a quadric is that no ray is inside of for ever.
template <class T>
struct BoundedPart {
  PixelBox box;
  Range<T> depth;
};

// Nothing where a is not more than 0 or its outline no ellipse.
template <class T>
std::optional<BoundedPart<T>> bounded_part(const geometry::ScreenQuadric<T>& quadric, const PixelBox& screen) {
  if (!(T(0.0) < quadric.a)) return std::nullopt;
  const auto ellipse = ellipse_of(quadric.discriminant);
  if (!ellipse) return std::nullopt;
  BoundedPart<T> part{ellipse->box(T(0.0), screen), {T(0.0), T(0.0)}};
  if (part.box.empty()) return part;
  part.depth = range_in(quadric.middle, part.box);
  const T root = geometry::square_root(ellipse->at_middle);  // the largest
  part.depth.least = part.depth.least - root;
  part.depth.most = part.depth.most + root;
  return part;
}

// Rounding of the host's own numbers, in parts of the depth from near to far: what is nearer than this to near or far
// counts as between.
inline constexpr double kDepthSlack = 0x1p-30;

// Whether no depth can be within all planes and `depth` on any pixel of the box.
template <class T>
bool nothing_between(std::span<const geometry::ScreenPlane<T>> planes, const PixelBox& box, const Range<T>& depth) {
  using Keeps = typename geometry::ScreenPlane<T>::Keeps;
  T from = depth.least < T(0.0) ? T(0.0) : depth.least;
  T to = depth.most > T(1.0) ? T(1.0) : depth.most;
  for (const auto& plane : planes) {
    const Range<T> at = range_in(plane.depth, box);
    if (plane.keeps == Keeps::side && T(0.0) < at.least) return true;
    if (plane.keeps == Keeps::beyond && from < at.least) from = at.least;
    if (plane.keeps == Keeps::before && at.most < to) to = at.most;
  }
  return to + T(kDepthSlack) < from;
}

}  // namespace rastertlm::set_up
