#include "src/analysis/random_triangles.h"

#include <algorithm>
#include <cmath>

namespace rastertlm::analysis {
namespace {

using geometry::SnapGrid;

// Where corners may be.
struct Range {
  double low_x, high_x, low_y, high_y;
};

Range range_of(const TriangleScreen& screen, const SnapGrid& grid) {
  const geometry::Viewport view = screen.viewport();
  return {-static_cast<double>(grid.guard_x), static_cast<double>(view.columns) - 1 + static_cast<double>(grid.guard_x),
          -static_cast<double>(grid.guard_y), static_cast<double>(view.lines) - 1 + static_cast<double>(grid.guard_y)};
}

// At an end of the range, or a few steps of the grid from it, or anywhere.
double near_limit(double low, double high, double step, Numbers& numbers) {
  const std::int64_t choice = numbers.whole(0, 4);
  const double off = static_cast<double>(numbers.whole(0, 3)) * step;
  if (choice < 2) return low + off;
  if (choice < 4) return high - off;
  return numbers.uniform(low, high);
}

// A third corner beside the first two, so far off that the longest side is `aspect` times the height.
Corner beside(const Corner& a, const Corner& b, double aspect, Numbers& numbers) {
  const double part = numbers.uniform(0.2, 0.8);
  const double dx = b.x - a.x, dy = b.y - a.y;
  return {a.x + part * dx - dy / aspect, a.y + part * dy + dx / aspect};
}

}  // namespace

void TriangleShape::declare(parameter::Table& table) {
  const std::string moves = "the catalogue's figures";
  table.choice("family", family,
               {"well_shaped", "level", "upright", "near_level", "sliver", "on_samples", "between_samples", "limits"},
               {"", "Which triangles are drawn at random.", moves});
  table.real("aspect", aspect, {1.0, 1e8}, {"", "Of slivers: longest side by height.", moves});
  table.real("height_pixels", height_pixels, {0.0, 1e6, true}, {"pixels", "Of edges that are almost level.", moves});
}

SnapGrid TriangleShape::grid_of(const TriangleScreen& screen) const {
  if (family == TriangleFamily::limits) return screen.grids().guarded;
  SnapGrid grid = screen.grids().on_screen;
  grid.guard_x = grid.guard_y = 0;
  return grid;
}

Corners random_corners(const TriangleShape& shape, const TriangleScreen& screen, const SnapGrid& grid,
                       Numbers& numbers) {
  const Range range = range_of(screen, grid);
  const double step = std::ldexp(1.0, -grid.fraction_bits);
  const auto any = [&] {
    return Corner{numbers.uniform(range.low_x, range.high_x), numbers.uniform(range.low_y, range.high_y)};
  };
  Corners at{any(), any(), any()};
  switch (shape.family) {
    case TriangleFamily::well_shaped:
      break;
    case TriangleFamily::level:
      at[1].y = at[0].y;
      break;
    case TriangleFamily::upright:
      at[1].x = at[0].x;
      break;
    case TriangleFamily::near_level:
      at[1].y = at[0].y + (at[0].y + shape.height_pixels <= range.high_y ? shape.height_pixels : -shape.height_pixels);
      break;
    case TriangleFamily::sliver:
      at[2] = beside(at[0], at[1], shape.aspect, numbers);
      break;
    case TriangleFamily::on_samples:
      for (Corner& c : at) c = {std::round(c.x), std::round(c.y)};
      break;
    case TriangleFamily::between_samples:
      for (Corner& c : at)
        c = {std::min(std::floor(c.x) + 0.5, range.high_x), std::min(std::floor(c.y) + 0.5, range.high_y)};
      break;
    case TriangleFamily::limits:
      for (Corner& c : at)
        c = {near_limit(range.low_x, range.high_x, step, numbers),
             near_limit(range.low_y, range.high_y, step, numbers)};
      break;
  }
  return at;
}

}  // namespace rastertlm::analysis
