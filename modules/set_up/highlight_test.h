// Does a triangle hold the centre of a highlight? The H1 and H2 tests of 003, section 2.3, without square roots:
// templates over the number type. At a centre the normal lies in the plane of light, viewer and point (H1) and makes
// the same angle with both (H2); where the corners are on both sides of both, a centre may lie between them.
#pragma once

#include <cstdint>

#include "src/geometry/lighting.h"
#include "src/geometry/projection.h"

namespace rastertlm::set_up {

template <class T>
geometry::Vector3<T> cross(const geometry::Vector3<T>& a, const geometry::Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A light and the viewer as the tests see them, in the space of the positions: where they are, or, infinitely far, in
// which direction.
struct HighlightSource {
  bool light_at_point = false;
  glm::dvec3 light{0, 0, 1};
  bool viewer_at_point = false;
  glm::dvec3 viewer{0, 0, 1};
};

// From a point to the light and to the viewer, of any length.
template <class T>
struct TwoDirections {
  geometry::Vector3<T> light;
  geometry::Vector3<T> viewer;
};

template <class T>
TwoDirections<T> directions_at(const HighlightSource& source, const geometry::Vector3<T>& position) {
  const auto towards = [&](bool at_point, const glm::dvec3& v) {
    const geometry::Vector3<T> given{T(v.x), T(v.y), T(v.z)};
    return at_point ? given - position : given;
  };
  return {towards(source.light_at_point, source.light), towards(source.viewer_at_point, source.viewer)};
}

// On which sides a corner is, a bit each. What is exactly between is on both sides: a centre on a corner or an edge is
// never missed, nor is one whose light and viewer lie in one direction, which makes every plane a plane of both.
enum HighlightSides : std::uint8_t {
  h1_positive = 1,
  h1_negative = 2,
  h2_positive = 4,  // nearer to the viewer than to the light
  h2_negative = 8,
  not_turned_away = 16,  // from one of the two at least
};

template <class T>
std::uint8_t h1_sides(const TwoDirections<T>& at, const geometry::Vector3<T>& normal) {
  const T volume = geometry::dot(cross(at.light, at.viewer), normal);
  const bool above = !(volume < T(0.0)), below = !(volume > T(0.0));
  return static_cast<std::uint8_t>((above ? h1_positive : 0) | (below ? h1_negative : 0));
}

// cos theta = PV.N / |PV| against cos phi = PL.N / |PL|, both times |N|: signs first, then squares.
template <class T>
std::uint8_t h2_sides(const TwoDirections<T>& at, const geometry::Vector3<T>& normal) {
  const T viewer = geometry::dot(at.viewer, normal), light = geometry::dot(at.light, normal);
  const bool viewer_behind = viewer < T(0.0), light_behind = light < T(0.0);
  const std::uint8_t turned = viewer_behind && light_behind ? 0 : not_turned_away;
  if (viewer_behind != light_behind)
    return static_cast<std::uint8_t>(turned | (light_behind ? h2_positive : h2_negative));
  const T a = viewer * viewer * geometry::dot(at.light, at.light);
  const T b = light * light * geometry::dot(at.viewer, at.viewer);
  // Both behind: the larger square is the smaller cosine.
  const bool more = viewer_behind ? !(a > b) : !(a < b);
  const bool less = viewer_behind ? !(a < b) : !(a > b);
  return static_cast<std::uint8_t>(turned | (more ? h2_positive : 0) | (less ? h2_negative : 0));
}

template <class T>
std::uint8_t highlight_sides(const HighlightSource& source, const geometry::Vector3<T>& position,
                             const geometry::Vector3<T>& normal) {
  const TwoDirections<T> at = directions_at<T>(source, position);
  return h1_sides(at, normal) | h2_sides(at, normal);
}

// Potentially highlighted: its corners' bits are all there together.
inline bool may_be_highlighted(std::uint8_t a, std::uint8_t b, std::uint8_t c) {
  constexpr std::uint8_t kAll = h1_positive | h1_negative | h2_positive | h2_negative | not_turned_away;
  return (a | b | c) == kAll;
}

}  // namespace rastertlm::set_up
