#include "src/analysis/projected_quad.h"

#include <algorithm>
#include <cmath>

#include "src/geometry/clipping.h"

namespace rastertlm::analysis {
namespace {

using geometry::ClipTriangle;
using geometry::FrameGrid;
using geometry::Polygon;
using geometry::ScreenVertex;
using geometry::Viewport;

const glm::dvec3 kNormal(0.0, 0.0, 1.0);
const glm::dmat3 kNormalsStay(1.0);

template <class T>
std::array<ClipTriangle<T>, 2> clip_triangles(const SpaceQuad& quad) {
  std::array<geometry::ClipVertex<T>, 4> at;
  for (std::size_t i = 0; i < 4; ++i)
    at[i] = set_up::transform_vertex<T>(quad.corners[i], kNormal, quad.object_to_clip, kNormalsStay);
  return {ClipTriangle<T>{at[0], at[1], at[2]}, ClipTriangle<T>{at[0], at[2], at[3]}};
}

// Whether a corner of a clipped polygon lies on the edge between two corners: in clip space, where it is straight, and
// without rounding, so that nothing else comes as near.
bool lies_on_edge(const geometry::Vector4<Traced>& p, const geometry::Vector4<Traced>& a,
                  const geometry::Vector4<Traced>& b) {
  Quad along = 0, length = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    const Quad d = b[i].exact() - a[i].exact();
    along += d * (p[i].exact() - a[i].exact());
    length += d * d;
  }
  if (!(length > 0)) return false;
  const Quad t = along / length;
  for (int i = 0; i < 4; ++i) {
    const Quad off = p[i].exact() - a[i].exact() - t * (b[i].exact() - a[i].exact());
    size += off * off;
  }
  return to_double(size / length) < 1e-40;
}

// Whether a part of the edge lies inside all planes of the volume, by more than rounding.
bool is_seen(const geometry::Vector4<Traced>& a, const geometry::Vector4<Traced>& b, const FrameGrid& frame) {
  Quad first = 0, last = 1;
  for (int plane = 0; plane < geometry::kClipPlanes; ++plane) {
    const Quad da = geometry::plane_distance(a, plane, frame.volume).exact();
    const Quad db = geometry::plane_distance(b, plane, frame.volume).exact();
    if (da < 0 && db < 0) return false;
    if (da >= 0 && db >= 0) continue;
    const Quad t = da / (da - db);
    (da < 0 ? first : last) = da < 0 ? std::max(first, t) : std::min(last, t);
  }
  return to_double(last - first) > 1e-9;
}

bool same_place(const ScreenVertex<double>& a, const ScreenVertex<double>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Corners of the pieces of a triangle: those of the polygon.
std::vector<ScreenVertex<double>> corners_of(const set_up::Pieces<double>& pieces) {
  std::vector<ScreenVertex<double>> corners;
  for (const auto& piece : pieces.list())
    for (const auto& corner : piece)
      if (std::none_of(corners.begin(), corners.end(), [&](const auto& c) { return same_place(c, corner); }))
        corners.push_back(corner);
  return corners;
}

class Tracer {
 public:
  Tracer(ProjectedQuad& result, const FrameGrid& frame, const Viewport& viewport)
      : result_(result), frame_(frame), viewport_(viewport) {}

  // `edge`: the corner opposite to the common edge.
  void trace(const ClipTriangle<Traced>& triangle, std::size_t apart) {
    const Polygon<Traced> polygon = geometry::clip_to_frame(triangle, frame_);
    std::vector<ScreenVertex<Traced>> corners;
    std::vector<bool> common;
    const auto& from = triangle[(apart + 1) % 3].position;
    const auto& to = triangle[(apart + 2) % 3].position;
    for (std::size_t i = 0; i < polygon.size; ++i) {
      corners.push_back(geometry::to_screen(polygon.corners[i], viewport_));
      common.push_back(lies_on_edge(polygon.corners[i].position, from, to));
      note(corners.back());
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t next = (i + 1) % corners.size();
      if (common[i] && common[next]) continue;
      result_.outline.push_back({ScreenPosition{corners[i].x.exact(), corners[i].y.exact()},
                                 ScreenPosition{corners[next].x.exact(), corners[next].y.exact()}});
    }
  }

 private:
  void note(const ScreenVertex<Traced>& corner) {
    for (const Traced* value : {&corner.x, &corner.y}) {
      if (value->error() * result_.position_bound >= result_.position_error * value->bound()) {
        result_.position_error = value->error();
        result_.position_bound = value->bound();
      }
      result_.most_moved = std::max(result_.most_moved, value->bound());
    }
    result_.depth_moved = std::max(result_.depth_moved, corner.z.bound());
  }

  ProjectedQuad& result_;
  const FrameGrid& frame_;
  const Viewport& viewport_;
};

std::array<geometry::Vector4<Traced>, 3> positions(const ClipTriangle<Traced>& triangle) {
  return {triangle[0].position, triangle[1].position, triangle[2].position};
}

}  // namespace

ExactTriangle::ExactTriangle(const std::array<geometry::Vector4<Traced>, 3>& clip, const Viewport& viewport) {
  const Quad half_columns = static_cast<double>(viewport.columns) / 2,
             half_lines = static_cast<double>(viewport.lines) / 2;
  std::array<Row, 3> v;  // pixels times w, and w
  for (std::size_t i = 0; i < 3; ++i) {
    const Quad x = clip[i].x.exact(), y = clip[i].y.exact(), w = clip[i].w.exact();
    v[i] = {x * half_columns + w * (half_columns - static_cast<Quad>(0.5)),
            w * (half_lines - static_cast<Quad>(0.5)) - y * half_lines, w};
  }
  const auto cross = [](const Row& a, const Row& b) {
    return Row{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  for (std::size_t i = 0; i < 3; ++i) weights_[i] = cross(v[(i + 1) % 3], v[(i + 2) % 3]);
  const Quad determinant = v[0][0] * weights_[0][0] + v[0][1] * weights_[0][1] + v[0][2] * weights_[0][2];
  orientation_ = determinant < 0 ? 1 : (determinant > 0 ? -1 : 0);
  depth_ = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      if (orientation_ != 0) weights_[i][k] /= determinant;
      depth_[k] += weights_[i][k] * clip[i].z.exact();
    }
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) rough_[i][k] = to_double(weights_[i][k]);
    rough_[3][k] = to_double(depth_[k]);
    depth_near_[k] = static_cast<Extended>(depth_[k]);
  }
}

int ExactTriangle::count(double x, double y) const {
  const auto at = [&](std::size_t i) { return rough_[i][0] * x + rough_[i][1] * y + rough_[i][2]; };
  if (at(0) < 0 || at(1) < 0 || at(2) < 0) return 0;
  const double z = at(3);
  return z < 0 || z > 1 ? 0 : orientation_;
}

int ExactTriangle::count_exactly(Quad x, Quad y) const {
  for (const Row& row : weights_)
    if (row[0] * x + row[1] * y + row[2] < 0) return 0;
  const Quad z = depth_[0] * x + depth_[1] * y + depth_[2];
  return z < 0 || z > 1 ? 0 : orientation_;
}

double ProjectedQuad::distance_from_outline(double x, double y) const {
  double nearest = 1e300;
  for (const auto& [a, b] : outline) {
    const Quad dx = b.x - a.x, dy = b.y - a.y;
    const Quad length = dx * dx + dy * dy;
    Quad t = length > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / length : static_cast<Quad>(0);
    t = t < 0 ? static_cast<Quad>(0) : (t > 1 ? static_cast<Quad>(1) : t);
    nearest = std::min(nearest, std::hypot(to_double(x - a.x - t * dx), to_double(y - a.y - t * dy)));
  }
  return nearest;
}

ProjectedQuad project(const SpaceQuad& quad, const TriangleScreen& screen, const Tampering& tampering) {
  const Viewport viewport = screen.viewport();
  const auto given = clip_triangles<double>(quad);
  const auto traced = clip_triangles<Traced>(quad);
  bool guarded = false;
  for (const auto& triangle : given)
    guarded = guarded || geometry::needs_guard_band(triangle, screen.grids().on_screen, viewport);
  const FrameGrid frame = geometry::frame_grid(screen.grids(), guarded, viewport);
  ProjectedQuad result{frame.grid,
                       {set_up::pieces(given[0], frame, viewport), set_up::pieces(given[1], frame, viewport)},
                       {ExactTriangle(positions(traced[0]), viewport), ExactTriangle(positions(traced[1]), viewport)}};
  if (tampering.neighbours_corner)
    for (std::size_t piece = 0; piece < result.pieces[1].size; ++piece)
      for (auto& corner : result.pieces[1].triangles[piece]) tampering.neighbours_corner(corner);
  Tracer tracer(result, frame, viewport);
  tracer.trace(traced[0], 1);
  tracer.trace(traced[1], 2);
  result.common_edge_is_seen = is_seen(traced[0][0].position, traced[0][2].position, frame);
  const auto second = corners_of(result.pieces[1]);
  for (const auto& corner : corners_of(result.pieces[0]))
    result.common_corners +=
        std::any_of(second.begin(), second.end(), [&](const auto& c) { return same_place(c, corner); }) ? 1 : 0;
  return result;
}

}  // namespace rastertlm::analysis
