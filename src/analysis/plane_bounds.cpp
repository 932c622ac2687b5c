#include "src/analysis/plane_bounds.h"

#include <algorithm>
#include <cmath>

namespace rastertlm::analysis {
namespace {

constexpr double kHalfPlace = 0x1p-53;

}  // namespace

PlaneBound plane_bound(const set_up::WordFormat& format, const geometry::SnapGrid& grid, bool guarded, double largest,
                       double doubled_area) {
  const double side_x = static_cast<double>(format.columns) - 1, side_y = static_cast<double>(format.lines) - 1;
  PlaneBound bound;
  bound.rounding = 0.5 * (side_x / 2 + side_y / 2 + 1);
  const double box_x = side_x + (guarded ? 2 * static_cast<double>(grid.guard_x) : 0.0);
  const double box_y = side_y + (guarded ? 2 * static_cast<double>(grid.guard_y) : 0.0);
  const double squares = std::ldexp(1.0, 2 * grid.fraction_bits) / doubled_area;  // grid squares a pixel
  const double slopes = 3 * kHalfPlace * 2 * largest * squares * (box_y * side_x / 2 + box_x * side_y / 2);
  const double weight = guarded ? std::max(1.0, 2 * box_x * box_y * squares) : 1.0;
  const double at_anchor = 5 * kHalfPlace * 2 * largest * weight;
  // What all share: the reciprocal's rounding, the corners' values and the sum at the anchor.
  const double shared = 8 * kHalfPlace * std::ldexp(1.0, format.word_bits);
  bound.computing = (slopes + at_anchor + shared) * (1 + 1e-9);
  return bound;
}

double area_within_margin(const set_up::WordFormat& format, const geometry::SnapGrids& grids) {
  const auto depths = static_cast<double>(set_up::far_depth(format) - set_up::near_depth(format));
  const auto margin = static_cast<double>(set_up::depth_margin(format));
  double area = 1.0;
  while (area < 0x1p60 && (plane_bound(format, grids.on_screen, false, depths, area).total() > margin ||
                           plane_bound(format, grids.guarded, true, depths, area).total() > margin))
    area *= 2;
  return area;
}

double scaled_edge_bound(const set_up::WordFormat& format) {
  const double side_x = static_cast<double>(format.columns) - 1, side_y = static_cast<double>(format.lines) - 1;
  const double farthest = side_x + side_y;
  const double room = std::ldexp(1.0, format.word_bits - 1) - 2 - 0.5 * farthest;
  const double length = room / (2 * std::hypot(side_x, side_y)) - std::sqrt(0.5);  // A and B are rounded
  return 0.5 * (farthest + 1) / length;
}

}  // namespace rastertlm::analysis
