// How far the words of a triangle processor can be from the planes and edges of its snapped corners.
//
// A plane's slopes are rounded to half a unit, then its constant at the anchor, which is the middle of what is seen of
// the triangle's box: 1/2 (|dx| + |dy| + 1) units at a distance of dx and dy, and no sample of the screen is further
// from an anchor than half of the screen's sides, where the sample lies in the box. Before they are rounded, slopes and
// the value at the anchor are computed in double, u = 2^-53: a slope is a sum of two products of a difference of
// values, 2^-f pixel of edge over the doubled area, each at most 3 u off; the value at the anchor has two weights. On
// slivers, a unit of the grid in doubled area, that is more than a unit of depth. The middle of a box lies in its
// triangle, so that weights are at most 1; where the box is cut by the screen they are at most the box by the area.
#pragma once

#include "modules/set_up/word_format.h"
#include "src/geometry/snapping.h"

namespace rastertlm::analysis {

struct PlaneBound {
  double rounding = 0.0;   // of the three words
  double computing = 0.0;  // in double, of the thinnest triangle
  double total() const { return rounding + computing; }
};

// Units of the word. `largest`: of the differences between two corners' values. `guarded`: corners may lie off the
// screen. `doubled_area`: of the smallest triangle, in units of the grid's squares.
PlaneBound plane_bound(const set_up::WordFormat& format, const geometry::SnapGrid& grid, bool guarded, double largest,
                       double doubled_area = 1.0);

// The least doubled area, in squares of the grid and as a power of two, at which depths cannot wrap: their bound is the
// margin of set_up::depth_margin() at most.
double area_within_margin(const set_up::WordFormat& format, const geometry::SnapGrids& grids);

// Pixels that an edge at a scale of its own may be displaced by, of all edges that cross the screen: at most 1/2 (|dx|
// + |dy| + 1) / |(A, B)|. The scale is the largest power of two at which no sample leaves the word, so |(A, B)| is more
// than half of the word's room over the screen's diagonal.
double scaled_edge_bound(const set_up::WordFormat& format);

}  // namespace rastertlm::analysis
