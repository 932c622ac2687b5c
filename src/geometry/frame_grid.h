// Which grid a frame is snapped to, and the pieces of a triangle that are drawn: written once, because the machine's
// host and the exact renderers must agree on both to the last bit.
//
// The rule: a frame uses the fine grid (`SnapGrids::on_screen`) if no triangle of it needs the guard band, else every
// triangle of the frame uses `SnapGrids::guarded`. A triangle needs the guard band if one of its corners does, whether
// or not the triangle faces the viewer and also where it lies wholly outside one plane of the view volume. A corner
// needs it if it fails the near or the far plane or if its position, snapped to the fine grid, is not within the
// samples of the screen. Those that need the band are clipped to it; the others are drawn as they are, in any frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/geometry/clipping.h"
#include "src/geometry/projection.h"
#include "src/geometry/snapping.h"

namespace rastertlm::geometry {

template <class T>
using ClipTriangle = std::array<ClipVertex<T>, 3>;

// Between the near and the far plane, both included. False for NaN. w is then positive, for the near plane lies before
// the eye.
template <class T>
bool within_depth(const ClipVertex<T>& vertex) {
  return vertex.position.z >= T(0.0) && vertex.position.z <= vertex.position.w;
}

// Whether the position, snapped to `grid`, lies in [0, columns - 1] x [0, lines - 1]. False for NaN and whatever is too
// far to snap.
template <class T>
bool within_samples(const ScreenVertex<T>& vertex, const SnapGrid& grid, const Viewport& viewport) {
  const T columns = T(static_cast<double>(viewport.columns));
  const T lines = T(static_cast<double>(viewport.lines));
  if (!(vertex.x > T(-1.0) && vertex.x < columns && vertex.y > T(-1.0) && vertex.y < lines)) return false;
  const SnappedPoint point = snap(vertex, grid.fraction_bits);
  const std::int64_t last_x = (static_cast<std::int64_t>(viewport.columns) - 1) << grid.fraction_bits;
  const std::int64_t last_y = (static_cast<std::int64_t>(viewport.lines) - 1) << grid.fraction_bits;
  charge_integer<T>(4, 0);
  return point.x >= 0 && point.x <= last_x && point.y >= 0 && point.y <= last_y;
}

// `on_screen` is the fine grid of the screen's SnapGrids.
template <class T>
bool needs_guard_band(const ClipVertex<T>& vertex, const SnapGrid& on_screen, const Viewport& viewport) {
  return !within_depth(vertex) || !within_samples(to_screen(vertex, viewport), on_screen, viewport);
}

template <class T>
bool needs_guard_band(const ClipTriangle<T>& triangle, const SnapGrid& on_screen, const Viewport& viewport) {
  for (const ClipVertex<T>& vertex : triangle)
    if (needs_guard_band(vertex, on_screen, viewport)) return true;
  return false;
}

// What a frame is drawn with, once it is known whether any of its triangles needs the guard band.
struct FrameGrid {
  bool guarded = false;
  SnapGrid grid;
  ClipVolume volume;  // meant for guarded frames; others are not clipped
};

inline FrameGrid frame_grid(const SnapGrids& grids, bool guarded, const Viewport& viewport) {
  const SnapGrid& grid = guarded ? grids.guarded : grids.on_screen;
  return {guarded, grid, clip_volume(grid, viewport)};
}

// The polygon that is drawn of a triangle: 0 or 3..9 corners in the order of the triangle's. Its pieces are the
// triangles (0, k, k + 1), k = 1 .. size - 2. A frame on the fine grid is not clipped: a corner may lie a fraction of
// the grid's step outside, and is snapped onto the outermost sample.
template <class T>
Polygon<T> clip_to_frame(const ClipTriangle<T>& triangle, const FrameGrid& frame) {
  unsigned crossed = 0;
  if (frame.guarded) {
    unsigned outside_all = (1U << kClipPlanes) - 1;
    for (const ClipVertex<T>& vertex : triangle) {
      const unsigned code = outcode(vertex.position, frame.volume);
      crossed |= code;
      outside_all &= code;
    }
    if (outside_all != 0) return {};
  }
  return clip(triangle, crossed, frame.volume);
}

}  // namespace rastertlm::geometry
