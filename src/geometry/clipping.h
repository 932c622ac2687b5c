// Clipping of triangles in clip space against the near and far planes and a guard band around the screen (Sutherland
// and Hodgman).
//
// Two triangles that share an edge get bit-identical vertices on it: an intersection is computed with the edge's end
// points in a canonical order, so that it does not depend on which way round the edge is walked.
#pragma once

#include <array>
#include <cstdint>

#include "src/geometry/projection.h"

namespace rastertlm::geometry {

// Limits in normalised device coordinates, in the order of the planes: near, far, left, right, top, bottom.
struct ClipVolume {
  double left = -1.0;
  double right = 1.0;
  double bottom = -1.0;
  double top = 1.0;
};

inline constexpr int kClipPlanes = 6;
inline constexpr std::size_t kMaxPolygonCorners = 3 + kClipPlanes;

template <class T>
struct Polygon {
  std::array<ClipVertex<T>, kMaxPolygonCorners> corners;
  std::size_t size = 0;
  void add(const ClipVertex<T>& vertex) { corners[size++] = vertex; }
};

// Signed distance to plane `plane`, in clip units; 0 or more is inside.
template <class T>
T plane_distance(const Vector4<T>& p, int plane, const ClipVolume& volume) {
  switch (plane) {
    case 0:
      return p.z;
    case 1:
      return p.w - p.z;
    case 2:
      return p.x - T(volume.left) * p.w;
    case 3:
      return T(volume.right) * p.w - p.x;
    case 4:
      return T(volume.top) * p.w - p.y;
    default:
      return p.y - T(volume.bottom) * p.w;
  }
}

// Bit `plane` is set where the point is outside that plane.
template <class T>
unsigned outcode(const Vector4<T>& p, const ClipVolume& volume) {
  unsigned code = 0;
  for (int plane = 0; plane < kClipPlanes; ++plane)
    if (plane_distance(p, plane, volume) < T(0.0)) code |= 1U << plane;
  return code;
}

// Any total order of positions will do, as long as it is the same from both sides of the edge.
template <class T>
bool canonically_before(const Vector4<T>& a, const Vector4<T>& b) {
  for (int i = 0; i < 4; ++i) {
    if (plain(a[i]) < plain(b[i])) return true;
    if (plain(b[i]) < plain(a[i])) return false;
  }
  return false;
}

template <class T>
ClipVertex<T> intersection(const ClipVertex<T>& p, const ClipVertex<T>& q, int plane, const ClipVolume& volume) {
  const bool in_order = canonically_before(p.position, q.position);
  const ClipVertex<T>& a = in_order ? p : q;
  const ClipVertex<T>& b = in_order ? q : p;
  const T da = plane_distance(a.position, plane, volume);
  const T db = plane_distance(b.position, plane, volume);
  const T t = da / (da - db);
  ClipVertex<T> vertex;
  for (int i = 0; i < 4; ++i) vertex.position[i] = a.position[i] + t * (b.position[i] - a.position[i]);
  for (int i = 0; i < 3; ++i) vertex.normal[i] = a.normal[i] + t * (b.normal[i] - a.normal[i]);
  return vertex;
}

// Clips against the planes whose bits are set in `planes`. The result has 0 or 3..9 corners in the order of the input.
template <class T>
Polygon<T> clip(const std::array<ClipVertex<T>, 3>& triangle, unsigned planes, const ClipVolume& volume) {
  Polygon<T> polygon;
  for (const ClipVertex<T>& vertex : triangle) polygon.add(vertex);
  for (int plane = 0; plane < kClipPlanes && polygon.size > 0; ++plane) {
    if ((planes >> plane & 1U) == 0) continue;
    Polygon<T> clipped;
    for (std::size_t i = 0; i < polygon.size; ++i) {
      const ClipVertex<T>& from = polygon.corners[i];
      const ClipVertex<T>& to = polygon.corners[(i + 1) % polygon.size];
      const bool from_inside = plane_distance(from.position, plane, volume) >= T(0.0);
      const bool to_inside = plane_distance(to.position, plane, volume) >= T(0.0);
      if (from_inside) clipped.add(from);
      if (from_inside != to_inside) clipped.add(intersection(from, to, plane, volume));
    }
    polygon = clipped;
  }
  if (polygon.size < 3) polygon.size = 0;
  return polygon;
}

}  // namespace rastertlm::geometry
