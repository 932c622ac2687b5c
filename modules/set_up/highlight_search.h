// Where in a triangle a highlight's centre is (003, section 3.1.1 and the appendix): the point Q that meets H1 on one
// edge and R on another, by a quadratic; on the line QR the point that meets H2; then H1 and H2 in turns. Templates
// over the number type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "modules/set_up/highlight_test.h"

namespace rastertlm::set_up {

// Positions and normals are linear between corners. Normals of any length.
template <class T>
struct SurfacePoint {
  geometry::Vector3<T> position{};
  geometry::Vector3<T> normal{};
};

template <class T>
struct FoundHighlight {
  // Weights of the corners; they add up to 1. Negative: beside the triangle.
  std::array<T, 3> centre{};
  // Where H1 is met on the edges from `apex` to the corners behind it: q to the next one, r to the one after.
  std::size_t apex = 0;
  T q{};
  T r{};
};

// Real roots of a x^2 + b x + c, the smaller first; none where all or no x is one. Without cancellation.
template <class T>
struct Roots {
  int count = 0;
  std::array<T, 2> at{};
};
template <class T>
Roots<T> roots(const T& a, const T& b, const T& c) {
  if (a == T(0.0)) {
    if (b == T(0.0)) return {};
    return {1, {-c / b, T(0.0)}};
  }
  const T discriminant = b * b - T(4.0) * a * c;
  if (discriminant < T(0.0)) return {};
  const T root = geometry::square_root(discriminant);
  const T q = T(-0.5) * (b < T(0.0) ? b - root : b + root);
  if (q == T(0.0)) return {1, {T(0.0), T(0.0)}};
  const T first = q / a, second = c / q;
  return first < second ? Roots<T>{2, {first, second}} : Roots<T>{2, {second, first}};
}

// Where on the line from a (0) to b (1) H1 is met: the root nearest to `wanted`. None: nowhere, or everywhere.
template <class T>
std::optional<T> h1_between(const HighlightSource& source, const SurfacePoint<T>& a, const SurfacePoint<T>& b,
                            const T& wanted) {
  using Vector = geometry::Vector3<T>;
  const TwoDirections<T> at = directions_at<T>(source, a.position);
  const Vector along = b.position - a.position, change = b.normal - a.normal;
  // PL x PV = across - t turning
  const Vector across = cross(at.light, at.viewer);
  Vector turning{T(0.0), T(0.0), T(0.0)};
  if (source.light_at_point) turning += cross(along, at.viewer);
  if (source.viewer_at_point) turning += cross(at.light, along);
  const auto found =
      roots<T>(-geometry::dot(turning, change), geometry::dot(across, change) - geometry::dot(turning, a.normal),
               geometry::dot(across, a.normal));
  if (found.count == 0) return std::nullopt;
  if (found.count == 1) return found.at[0];
  const T d0 = found.at[0] - wanted, d1 = found.at[1] - wanted;
  return d0 * d0 < d1 * d1 ? found.at[0] : found.at[1];
}

// Times |N|: 0 where H2 is met, with the sign of h2_sides.
template <class T>
T h2_measure(const HighlightSource& source, const SurfacePoint<T>& at) {
  const TwoDirections<T> to = directions_at<T>(source, at.position);
  return geometry::dot(geometry::normalised<T>(to.viewer), at.normal) -
         geometry::dot(geometry::normalised<T>(to.light), at.normal);
}

template <class T>
class HighlightSearch {
 public:
  HighlightSearch(const HighlightSource& source, const std::array<SurfacePoint<T>, 3>& corners)
      : source_(source), corners_(corners) {}

  // `refinements`: how often H1 and H2 are met in turns after the first estimate. None where the corners' H1 signs
  // enclose nothing, and where an estimate is so far away that its weights, if they are numbers at all, have lost the
  // digits by which they add up to 1.
  std::optional<FoundHighlight<T>> find(int refinements) const {
    FoundHighlight<T> found;
    const auto apex = apex_of();
    if (!apex) return adding_up(along_halfway());
    found.apex = *apex;
    const std::size_t next = (*apex + 1) % 3, after = (*apex + 2) % 3;
    const auto q = on_edge(*apex, next), r = on_edge(*apex, after);
    if (!q || !r) return std::nullopt;
    found.q = *q;
    found.r = *r;
    End one = end(between(corner(*apex), corner(next), *q)), other = end(between(corner(*apex), corner(after), *r));
    Weights centre = falsi(one, other);
    for (int k = 0; k < refinements; ++k) {
      const auto t = h1_between<T>(source_, corners_[*apex], point(centre), T(1.0));
      if (!t) break;
      const End on_plane = end(between(corner(*apex), centre, *t));
      if ((on_plane.measure < T(0.0)) == (one.measure < T(0.0)))
        one = on_plane;
      else
        other = on_plane;
      centre = falsi(one, other);
    }
    found.centre = centre;
    return adding_up(found);
  }

  SurfacePoint<T> point(const std::array<T, 3>& weights) const {
    SurfacePoint<T> result{{T(0.0), T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0)}};
    for (std::size_t i = 0; i < 3; ++i) {
      result.position += corners_[i].position * weights[i];
      result.normal += corners_[i].normal * weights[i];
    }
    return result;
  }

 private:
  using Weights = std::array<T, 3>;
  struct End {
    Weights at;
    T measure;
  };

  // A look at what was computed, no operation of it.
  static std::optional<FoundHighlight<T>> adding_up(const std::optional<FoundHighlight<T>>& found) {
    constexpr double kOff = 1e-6;
    double sum = 0.0;
    if (found)
      for (const T& weight : found->centre) sum += geometry::plain(weight);
    return std::fabs(sum - 1.0) <= kOff ? found : std::nullopt;
  }

  static Weights corner(std::size_t i) {
    Weights w{T(0.0), T(0.0), T(0.0)};
    w[i] = T(1.0);
    return w;
  }
  static Weights between(const Weights& a, const Weights& b, const T& t) {
    Weights w;
    for (std::size_t i = 0; i < 3; ++i) w[i] = a[i] + t * (b[i] - a[i]);
    return w;
  }
  End end(const Weights& at) const { return {at, h2_measure<T>(source_, point(at))}; }

  // Where the measure would be 0 if it were linear; half way where it does not change.
  static Weights falsi(const End& a, const End& b) {
    const T change = a.measure - b.measure;
    return between(a.at, b.at, change == T(0.0) ? T(0.5) : a.measure / change);
  }

  // The corner that is alone on its side of H1; what is on both counts to the smaller side. None: no corner is on any.
  std::optional<std::size_t> apex_of() const {
    std::array<int, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint8_t sides = h1_sides<T>(directions_at<T>(source_, corners_[i].position), corners_[i].normal);
      side[i] = ((sides & h1_positive) != 0 ? 1 : 0) - ((sides & h1_negative) != 0 ? 1 : 0);
    }
    if (side[0] == 0 && side[1] == 0 && side[2] == 0) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = side[i], b = side[(i + 1) % 3], c = side[(i + 2) % 3];
      if (a * b < 0 && a * c < 0) return i;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (side[i] == 0) return i;
    return std::size_t{0};  // all on one side
  }

  std::optional<T> on_edge(std::size_t from, std::size_t to) const {
    const auto t = h1_between<T>(source_, corners_[from], corners_[to], T(0.5));
    if (!t || *t < T(0.0) || *t > T(1.0)) return std::nullopt;
    return t;
  }

  // Light and viewer in one direction: the planes say nothing. The normal is parallel to the halfway vector of the
  // middle where a linear system says.
  std::optional<FoundHighlight<T>> along_halfway() const {
    const T third(1.0 / 3.0);
    const TwoDirections<T> at = directions_at<T>(source_, point({third, third, third}).position);
    const geometry::Vector3<T> halfway = geometry::normalised<T>(at.light) + geometry::normalised<T>(at.viewer);
    FoundHighlight<T> found;
    T sum(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
      found.centre[i] = geometry::dot(cross(corners_[(i + 1) % 3].normal, corners_[(i + 2) % 3].normal), halfway);
      sum += found.centre[i];
    }
    if (sum == T(0.0)) return std::nullopt;
    for (T& w : found.centre) w = w / sum;
    found.q = found.r = T(0.5);
    return found;
  }

  const HighlightSource& source_;
  const std::array<SurfacePoint<T>, 3>& corners_;
};

}  // namespace rastertlm::set_up
