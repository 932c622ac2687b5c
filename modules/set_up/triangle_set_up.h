// From a triangle on the screen to the words of a triangle processor: what the modelled host computes for every
// triangle and frame. T is double, or geometry::Counted<double> to count the operations; the words are the same.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "modules/object_processor/triangle_processor.h"
#include "modules/set_up/edge_equations.h"
#include "modules/set_up/plane_equations.h"
#include "modules/set_up/word_format.h"
#include "src/geometry/counted.h"
#include "src/geometry/projection.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up {

template <class T>
using ScreenTriangle = std::array<geometry::ScreenVertex<T>, 3>;

enum class Outcome {
  drawn,
  back_face,   // turned away, and not two-sided
  degenerate,  // no area once snapped, or no position at all; its processor is parked
};

struct SetUpResult {
  Outcome outcome = Outcome::degenerate;
  object_processor::TriangleWords words;  // parked unless drawn
};

// Facing and the planes of scaled edges take corners on this grid, fine enough to be the corners themselves.
inline constexpr int kScaledFractionBits = 12;

namespace detail {

// A guard of the model: after clipping, only rounding or numbers near the end of double's range can leave the limits.
template <class T>
T limited(const T& value, double low, double high) {
  const double v = geometry::plain(value);
  if (v < low) return T(low);
  return v > high ? T(high) : value;
}

// The corner with its position and depth inside the guard band and the depth range; nothing where it has no position.
template <class T>
std::optional<geometry::ScreenVertex<T>> within_guard(geometry::ScreenVertex<T> corner, const geometry::SnapGrid& grid,
                                                      const WordFormat& format) {
  for (const T& value : {corner.x, corner.y, corner.z})
    if (std::isnan(geometry::plain(value))) return std::nullopt;
  const auto guard_x = static_cast<double>(grid.guard_x);
  const auto guard_y = static_cast<double>(grid.guard_y);
  corner.x = limited(corner.x, -guard_x, static_cast<double>(format.columns) - 1 + guard_x);
  corner.y = limited(corner.y, -guard_y, static_cast<double>(format.lines) - 1 + guard_y);
  corner.z = limited(corner.z, 0.0, 1.0);
  for (int i = 0; i < 3; ++i) corner.normal[i] = limited(corner.normal[i], -1.0, 1.0);
  return corner;
}

template <class T>
LinearWords edge_words(const ScreenTriangle<T>& triangle, const std::array<geometry::SnappedPoint, 3>& points,
                       std::size_t edge, int fraction_bits, const WordFormat& format) {
  const std::size_t next = (edge + 1) % 3;
  if (format.edges == EdgeForm::snapped)
    return snapped_edge<T>(points[edge], points[next], fraction_bits, format.word_bits);
  return scaled_edge<T>({triangle[edge].x, triangle[edge].y}, {triangle[next].x, triangle[next].y}, format);
}

template <class T>
void fit_planes(const ScreenTriangle<T>& triangle, const PlaneFit<T>& plane, bool turned, const WordFormat& format,
                object_processor::TriangleWords& words) {
  const auto depth_range = static_cast<double>(far_depth(format) - near_depth(format));
  const auto nearest = static_cast<double>(near_depth(format));
  std::array<T, 3> values;
  for (std::size_t i = 0; i < 3; ++i) values[i] = triangle[i].z * T(depth_range) + T(nearest);
  words.depth = plane.fit(values);
  const auto unit = static_cast<double>(normal_unit(format));
  for (int component = 0; component < 3; ++component) {
    for (std::size_t i = 0; i < 3; ++i) values[i] = triangle[i].normal[component] * T(turned ? -unit : unit);
    words.normals[static_cast<std::size_t>(component)] = plane.fit(values);
  }
}

}  // namespace detail

// `corners`: pixels, depth 0..1 and components of the normal in -1..1, counter-clockwise to the eye where it is a front
// face, inside the guard band of `grid`, the frame's. A back face that is two-sided is drawn with its normals turned.
// Facing is that of the snapped corners, so that a triangle folded by the snap is dropped, or drawn as what it became.
template <class T>
SetUpResult set_up_triangle(const ScreenTriangle<T>& corners, std::uint32_t material, bool two_sided,
                            const geometry::SnapGrid& grid, const WordFormat& format) {
  SetUpResult result;
  const auto park = [&] {
    result.words = object_processor::parked_triangle(static_cast<unsigned>(format.word_bits));
    result.words.material = material;
  };

  const int fraction_bits = format.edges == EdgeForm::snapped ? grid.fraction_bits : kScaledFractionBits;
  ScreenTriangle<T> triangle;
  std::array<geometry::SnappedPoint, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corner = detail::within_guard(corners[i], grid, format);
    if (!corner) {
      park();
      return result;
    }
    triangle[i] = *corner;
    points[i] = geometry::snap(triangle[i], fraction_bits);
  }
  std::int64_t area = geometry::doubled_area(points[0], points[1], points[2]);
  geometry::charge_integer<T>(6, 2);
  const bool turned = !geometry::faces_viewer(area);
  if (area == 0 || (turned && !two_sided)) {
    if (area != 0) result.outcome = Outcome::back_face;
    park();
    return result;
  }
  if (turned) {
    std::swap(triangle[1], triangle[2]);
    std::swap(points[1], points[2]);
    area = -area;
  }
  for (std::size_t edge = 0; edge < 3; ++edge)
    result.words.edges[edge] = detail::edge_words(triangle, points, edge, fraction_bits, format);
  detail::fit_planes(triangle, PlaneFit<T>(points, area, fraction_bits, format), turned, format, result.words);
  result.words.material = material;
  result.outcome = Outcome::drawn;
  return result;
}

}  // namespace rastertlm::set_up
