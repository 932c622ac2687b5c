// The worst words of triangle processors that random and adversarial triangles find, set up as the host does it,
// against exact planes and edges.
#pragma once

#include <cstdint>

#include "modules/set_up/triangle_set_up.h"
#include "src/analysis/measurement.h"
#include "src/geometry/snapping.h"

namespace rastertlm::analysis {

// All over the screen; thin; with corners on the screen's outermost samples; in the guard band.
enum class PlaneFamily { any, sliver, corners, guarded };

struct PlaneSeen {
  std::uint64_t triangles = 0;
  std::uint64_t samples = 0;    // in or on a triangle, where planes were compared
  std::uint64_t tests = 0;      // samples of the screen that edges were asked of
  double depth = 0.0;           // units
  double depth_of_large = 0.0;  // of triangles of `large` grid squares of doubled area, or more
  double normal = 0.0;
  double wrong = 0.0;      // samples on the wrong side of a snapped edge
  double displaced = 0.0;  // scaled edges: the furthest from the edge that such a sample was, pixels
};

PlaneSeen search_planes(const set_up::WordFormat& format, const geometry::SnapGrids& grids, Numbers& numbers,
                        std::int64_t triangles, double large = 1.0);

}  // namespace rastertlm::analysis
