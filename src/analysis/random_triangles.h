// Triangles on the screen that machines find hard, at random.
#pragma once

#include <array>

#include "src/analysis/measurement.h"
#include "src/analysis/triangle_screen.h"
#include "src/parameter/table.h"

namespace rastertlm::analysis {

// limits: corners at the ends of the guard band, where edge words are largest.
enum class TriangleFamily { well_shaped, level, upright, near_level, sliver, on_samples, between_samples, limits };

struct TriangleShape {
  TriangleFamily family = TriangleFamily::well_shaped;
  double aspect = 1.0;           // of slivers: longest side by height
  double height_pixels = 0.001;  // of edges that are almost level

  void declare(parameter::Table& table);
  // The frame's: the fine one where all of it is on the screen, and then without a band.
  geometry::SnapGrid grid_of(const TriangleScreen& screen) const;
};

struct Corner {
  double x, y;  // pixels
};
using Corners = std::array<Corner, 3>;

// Inside the guard band of the grid.
Corners random_corners(const TriangleShape& shape, const TriangleScreen& screen, const geometry::SnapGrid& grid,
                       Numbers& numbers);

}  // namespace rastertlm::analysis
