// The grid that vertices are snapped to before edges, depth and normals are fitted through them, and the guard band
// that they are clipped to: both follow from the word width of the edge processors.
//
// With coefficients A, B in units of 2^-q pixel and vertices and screen in a box of w x h pixels, |E| <= w * h * 2^q:
// no edge word of `word_bits` wraps on the screen if that stays below 2^(word_bits - 1). The sign bit is then exactly
// the top-left coverage test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "src/geometry/clipping.h"

namespace rastertlm::geometry {

// A frame uses one grid: `on_screen` if every vertex lies within the samples of the screen, `guarded` otherwise.
struct SnapGrid {
  int fraction_bits = 0;     // q: vertices are multiples of 2^-q pixel
  std::int64_t guard_x = 0;  // whole pixels beyond the outermost samples, each side
  std::int64_t guard_y = 0;
};

struct SnapGrids {
  SnapGrid on_screen;
  SnapGrid guarded;
};

// Nothing where no grid of whole pixels fits: the machine cannot draw at this size; see `word_bits_needed`. `limit` >=
// 0 caps q.
std::optional<SnapGrids> snap_grids(std::size_t columns, std::size_t lines, int word_bits, int limit);

// The narrowest edge word for which snap_grids gives a result.
int word_bits_needed(std::size_t columns, std::size_t lines);

// The volume that a frame with this grid is clipped to.
ClipVolume clip_volume(const SnapGrid& grid, const Viewport& viewport);

// A vertex on the grid, in units of 2^-q pixel.
struct SnappedPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend bool operator==(const SnappedPoint&, const SnappedPoint&) = default;
};

template <class T>
SnappedPoint snap(const ScreenVertex<T>& vertex, int fraction_bits) {
  const T scale = T(static_cast<double>(std::int64_t{1} << fraction_bits));
  return {to_integer(vertex.x * scale), to_integer(vertex.y * scale)};
}

// Twice the signed area in units of 4^-q square pixels; negative where the corners run counter-clockwise as seen (y
// points down).
inline std::int64_t doubled_area(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

// A front face: its corners run counter-clockwise to the eye.
inline bool faces_viewer(std::int64_t area) { return area < 0; }

}  // namespace rastertlm::geometry
