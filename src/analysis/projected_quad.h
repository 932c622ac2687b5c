// A quadrilateral of two triangles in space, as a machine's host puts it on the screen, and where it is without
// rounding.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "modules/set_up/pieces.h"
#include "src/analysis/traced.h"
#include "src/analysis/triangle_screen.h"

namespace rastertlm::analysis {

// Corners in object space, in order around it; the triangles are 0 1 2 and 0 2 3.
struct SpaceQuad {
  std::array<glm::dvec3, 4> corners;
  glm::dmat4 object_to_clip;
};

struct ScreenPosition {
  Quad x, y;
};

// A triangle that is linear in homogeneous coordinates of the screen, exact: what a sample sees of it without clipping.
class ExactTriangle {
 public:
  // In clip space, without rounding.
  ExactTriangle(const std::array<geometry::Vector4<Traced>, 3>& clip, const geometry::Viewport& viewport);

  // +1 or -1 as a front or a back face where the ray of the sample meets it between near and far; else 0. In double,
  // and, where that is not sure, `exactly`.
  int count(double x, double y) const;
  int count_exactly(Quad x, Quad y) const;
  // Depth 0..1 of its plane, linear on the screen: value, and a pixel along x and y.
  Extended depth(Extended x, Extended y) const { return depth_near_[0] * x + depth_near_[1] * y + depth_near_[2]; }
  double depth_slope(int axis) const { return to_double(absolute(depth_[static_cast<std::size_t>(axis)])); }

 private:
  using Row = std::array<Quad, 3>;  // a x + b y + c
  std::array<Row, 3> weights_;      // of the corners, by 1 / w
  Row depth_;
  std::array<Extended, 3> depth_near_;
  std::array<std::array<double, 3>, 4> rough_;  // the same in double
  int orientation_ = 0;
};

// What the host makes of the quadrilateral: pieces a triangle, as drawn and as exact as they are.
struct ProjectedQuad {
  geometry::SnapGrid grid;
  std::array<set_up::Pieces<double>, 2> pieces;
  std::array<ExactTriangle, 2> exact;
  double position_error = 0.0;  // of a corner of a piece, in pixels along an axis: largest part of the bound
  double position_bound = 0.0;  // there
  double most_moved = 0.0;      // the largest bound of all, in pixels
  double depth_moved = 0.0;     // likewise of depths 0..1
  // The outline, without the common edge, of what is drawn: between corners that are not rounded.
  std::vector<std::array<ScreenPosition, 2>> outline = {};
  bool common_edge_is_seen = false;  // by the volume that is clipped to, for sure
  std::int64_t common_corners = 0;   // of the pieces, the same in both triangles to the last bit

  double distance_from_outline(double x, double y) const;
};

// As the machine's host does: clipped to the guard band where any corner needs it.
ProjectedQuad project(const SpaceQuad& quad, const TriangleScreen& screen, const Tampering& tampering);

}  // namespace rastertlm::analysis
