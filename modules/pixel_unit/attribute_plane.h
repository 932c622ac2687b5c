// What lights see of a triangle, linear on the screen: normal, position and 1/w as planes. Templates over the number
// type: with Counted numbers the operations are those of the code that is run.
#pragma once

#include <array>
#include <cstdint>

#include "modules/set_up/point_lighting.h"
#include "src/geometry/counted.h"
#include "src/geometry/lighting.h"

namespace rastertlm::pixel_unit {

// A triangle as it is handed to the unit; normals are turned to the viewer where its back is seen.
struct PixelTriangle {
  std::array<set_up::LitPoint, 3> corners;  // on a grid of 2^-fraction_bits pixel, not in one line
  int fraction_bits = 0;
  std::size_t material = 0;
};

template <class T>
using Vector3 = geometry::Vector3<T>;

template <class T>
Vector3<T> scaled(const Vector3<T>& v, const T& by) {
  return {v.x * by, v.y * by, v.z * by};
}

// start + across x + down y, x and y in pixels from an origin that is named beside it.
template <class Value>
struct Plane {
  Value across{};
  Value down{};
  Value start{};
};

template <class T>
Vector3<T> value_at(const Plane<Vector3<T>>& plane, const T& x, const T& y) {
  return plane.start + scaled(plane.across, x) + scaled(plane.down, y);
}
template <class T>
T value_at(const Plane<T>& plane, const T& x, const T& y) {
  return plane.start + plane.across * x + plane.down * y;
}

// Fits planes through a triangle's corners, about corner 0.
template <class T>
class PlaneFit {
 public:
  explicit PlaneFit(const PixelTriangle& triangle) {
    const double unit = 1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits);
    const auto pixels = [unit](std::int64_t steps) { return geometry::from_integer<T>(steps) * T(unit); };
    const auto& [a, b, c] = triangle.corners;
    geometry::charge_integer<T>(4, 0);
    x2_ = pixels(b.at.x - a.at.x);
    y2_ = pixels(b.at.y - a.at.y);
    x3_ = pixels(c.at.x - a.at.x);
    y3_ = pixels(c.at.y - a.at.y);
    const T inverse = T(1.0) / (x2_ * y3_ - x3_ * y2_);
    across2_ = y3_ * inverse;
    across3_ = y2_ * inverse;
    down2_ = x3_ * inverse;
    down3_ = x2_ * inverse;
  }

  Plane<T> through(const T& v1, const T& v2, const T& v3) const {
    const T d2 = v2 - v1;
    const T d3 = v3 - v1;
    return {d2 * across2_ - d3 * across3_, d3 * down3_ - d2 * down2_, v1};
  }
  Plane<Vector3<T>> through(const Vector3<T>& v1, const Vector3<T>& v2, const Vector3<T>& v3) const {
    Plane<Vector3<T>> planes;
    for (int c = 0; c < 3; ++c) {
      const Plane<T> one = through(v1[c], v2[c], v3[c]);
      planes.across[c] = one.across;
      planes.down[c] = one.down;
      planes.start[c] = one.start;
    }
    return planes;
  }
  // The mean of the corners.
  T centre_x() const { return (x2_ + x3_) * T(1.0 / 3.0); }
  T centre_y() const { return (y2_ + y3_) * T(1.0 / 3.0); }

 private:
  T x2_, y2_, x3_, y3_;
  T across2_, across3_, down2_, down3_;
};

// What the planes of a triangle need not have.
struct PlaneNeeds {
  bool perspective = false;  // attributes are those of the surface, not linear on the screen
  bool positions = false;
};

// In perspective the planes are those of n/w, p/w and 1/w; a normal's direction is n/w's.
template <class T>
struct AttributePlanes {
  Plane<Vector3<T>> normal;
  Plane<Vector3<T>> position;
  Plane<T> inverse_w;
  T centre_x;  // of the triangle, from corner 0
  T centre_y;
};

template <class T>
Vector3<T> vector_of(const glm::dvec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
AttributePlanes<T> attribute_planes(const PixelTriangle& triangle, const PlaneNeeds& needs) {
  const PlaneFit<T> fit(triangle);
  std::array<Vector3<T>, 3> normals;
  std::array<Vector3<T>, 3> positions;
  std::array<T, 3> inverse_w;
  for (std::size_t i = 0; i < 3; ++i) {
    const set_up::LitPoint& corner = triangle.corners[i];
    normals[i] = vector_of<T>(corner.normal);
    positions[i] = vector_of<T>(corner.position);
    inverse_w[i] = T(corner.inverse_w);
    if (!needs.perspective) continue;
    normals[i] = scaled(normals[i], inverse_w[i]);
    if (needs.positions) positions[i] = scaled(positions[i], inverse_w[i]);
  }
  AttributePlanes<T> planes;
  planes.centre_x = fit.centre_x();
  planes.centre_y = fit.centre_y();
  planes.normal = fit.through(normals[0], normals[1], normals[2]);
  if (needs.positions) planes.position = fit.through(positions[0], positions[1], positions[2]);
  if (needs.positions && needs.perspective) planes.inverse_w = fit.through(inverse_w[0], inverse_w[1], inverse_w[2]);
  return planes;
}

}  // namespace rastertlm::pixel_unit
