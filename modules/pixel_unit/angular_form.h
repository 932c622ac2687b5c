// Kuijk and Blake's angular interpolation (1989): the normal turns at an even rate along a great circle, on edges from
// corner to corner and on a line from edge to edge, so that it needs no normalisation and its dot product with a
// constant vector is a cosine of an angle that grows evenly:
//   N(t).L = p cos(t psi) + q sin(t psi),  p = Na.L,  q = (Nb.L - p cos psi) / sin psi,
// which c(n+1) = 2 cos(delta) c(n) - c(n-1) gives from pixel to pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "modules/pixel_unit/attribute_plane.h"
#include "src/base/mathematics.h"

namespace rastertlm::pixel_unit {

// Sine, cosine and arc tangent of this thread since it started; take differences. Charged as the series of
// src/base/mathematics.h to double precision: hardware would look them up.
inline constinit thread_local std::uint64_t angle_functions = 0;

namespace angular_detail {

inline constexpr std::uint64_t kTerms = 10;

template <class T>
void charge_series() {
  if constexpr (!std::is_arithmetic_v<T>) {
    ++angle_functions;
    geometry::operation_counts.add += kTerms;
    geometry::operation_counts.multiply += kTerms;
  }
}

}  // namespace angular_detail

template <class T>
T sine(const T& x) {
  angular_detail::charge_series<T>();
  return T(mathematics::sin(geometry::plain(x)));
}
template <class T>
T cosine(const T& x) {
  angular_detail::charge_series<T>();
  return T(mathematics::cos(geometry::plain(x)));
}
template <class T>
T arc_tangent(const T& y, const T& x) {
  angular_detail::charge_series<T>();
  return T(mathematics::atan2(geometry::plain(y), geometry::plain(x)));
}

// From one unit vector to another at an even rate. Between opposite ones there are many ways: rounding takes one, or
// the vector is `from` cos(t pi).
template <class T>
struct Turn {
  Vector3<T> from{};
  Vector3<T> beside{};  // unit, square to `from`, in the plane of the two
  T angle{};

  static Turn between(const Vector3<T>& from, const Vector3<T>& to) {
    const T along = geometry::dot(from, to);
    const Vector3<T> rest = to - scaled(from, along);
    const T length = geometry::square_root(geometry::dot(rest, rest));
    Turn turn{from, rest, arc_tangent(length, along)};
    if (length > T(0.0)) turn.beside = scaled(rest, T(1.0) / length);
    return turn;
  }
  Vector3<T> at(const T& share) const {
    const T turned = share * angle;
    return scaled(from, cosine(turned)) + scaled(beside, sine(turned));
  }
};

// Of a triangle. Angles grow evenly on the screen, in perspective as well.
template <class T>
class AngularSteps {
 public:
  void set_up(const PixelTriangle& triangle, const std::vector<Vector3<T>>& vectors) {
    vectors_ = &vectors;
    along_.resize(vectors.size());
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return triangle.corners[a].at.y < triangle.corners[b].at.y; });
    geometry::charge_integer<T>(6, 0);
    std::array<Vector3<T>, 3> normals;
    for (std::size_t i = 0; i < 3; ++i)
      normals[i] = geometry::normalised<T>(vector_of<T>(triangle.corners[order[i]].normal));
    const double unit = 1.0 / static_cast<double>(std::int64_t{1} << triangle.fraction_bits);
    const auto& origin = triangle.corners[0].at;
    const auto edge = [&](std::size_t a, std::size_t b) {
      const auto& from = triangle.corners[order[a]].at;
      const auto& to = triangle.corners[order[b]].at;
      Edge made;
      made.x = geometry::from_integer<T>(from.x - origin.x) * T(unit);
      made.y = geometry::from_integer<T>(from.y - origin.y) * T(unit);
      const T width = geometry::from_integer<T>(to.x - from.x) * T(unit);
      const T height = geometry::from_integer<T>(to.y - from.y) * T(unit);
      made.level = to.y == from.y;
      geometry::charge_integer<T>(4, 0);
      if (!made.level) {
        made.inverse_height = T(1.0) / height;
        made.slope = width * made.inverse_height;
      }
      made.turn = Turn<T>::between(normals[a], normals[b]);
      return made;
    };
    long_ = edge(0, 2);
    upper_ = edge(0, 1);
    lower_ = edge(1, 2);
  }

  // The line at y, from its pixel at x on; both from corner 0.
  void begin_line(const T& x, const T& y) {
    const bool above = upper_.level ? false : (lower_.level || y < lower_.y);
    const Edge& other = above ? upper_ : lower_;
    End start = end_of(long_, y), end = end_of(other, y);
    if (end.x < start.x) std::swap(start, end);
    const Turn<T> turn = Turn<T>::between(start.normal, end.normal);
    const T width = end.x - start.x;
    const T delta = width > T(0.0) ? turn.angle / width : T(0.0);
    const T first = (x - start.x) * delta;
    const T c0 = cosine(first), s0 = sine(first);
    const T c1 = cosine(delta), s1 = sine(delta);
    twice_ = c1 + c1;
    has_normal_ = geometry::dot(start.normal, start.normal) > T(0.0);
    for (std::size_t k = 0; k < along_.size(); ++k) {
      const T p = geometry::dot(start.normal, (*vectors_)[k]);
      const T q = geometry::dot(turn.beside, (*vectors_)[k]);
      const T at = p * c0 + q * s0, square = q * c0 - p * s0;
      along_[k] = {at, at * c1 + square * s1};
    }
  }
  void step() {
    for (Along& one : along_) {
      const T next = twice_ * one.next - one.value;
      one.value = one.next;
      one.next = next;
    }
  }
  bool dots(std::vector<T>& dots) const {
    for (std::size_t k = 0; k < along_.size(); ++k) dots[k] = along_[k].value;
    return has_normal_;
  }

 private:
  struct Edge {
    T x{};
    T y{};  // of its upper end, from corner 0
    T inverse_height{};
    T slope{};
    bool level = false;
    Turn<T> turn;
  };
  struct End {
    T x{};
    Vector3<T> normal{};
  };
  // A dot product at this pixel and the next.
  struct Along {
    T value{};
    T next{};
  };

  End end_of(const Edge& edge, const T& y) const {
    const T below = y - edge.y;
    return {edge.x + below * edge.slope, edge.turn.at(below * edge.inverse_height)};
  }

  const std::vector<Vector3<T>>* vectors_ = nullptr;
  Edge long_;
  Edge upper_;
  Edge lower_;
  std::vector<Along> along_;
  T twice_{};
  bool has_normal_ = false;
};

}  // namespace rastertlm::pixel_unit
