// What a machine's own cores show of one triangle on the screen, whichever machine it is: set-up, then the object
// processor of a board, or the span unit.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "modules/set_up/triangle_set_up.h"
#include "modules/set_up/word_format.h"
#include "src/analysis/case_kind.h"
#include "src/analysis/exact_number.h"
#include "src/geometry/frame_grid.h"

namespace rastertlm::analysis {

// The plane of a value over a triangle whose corners are on a grid.
class SnappedPlane {
 public:
  // Values in units of the word. The corners must have an area.
  SnappedPlane(const std::array<geometry::SnappedPoint, 3>& corners, int fraction_bits,
               const std::array<double, 3>& values);

  // Off by far less than rounding() at the pixel.
  Extended at(std::int64_t x, std::int64_t y) const;
  // By how much doubles move what is computed at (dx, dy) from where the value is known, where at most 10 roundings
  // follow one another.
  double rounding(double dx, double dy) const;

  // A slope's terms with their absolute values: units a pixel.
  double steep_x() const { return steep_x_; }
  double steep_y() const { return steep_y_; }
  const std::array<geometry::SnappedPoint, 3>& corners() const { return corners_; }
  int fraction_bits() const { return fraction_bits_; }
  const std::array<double, 3>& values() const { return values_; }

 private:
  std::array<geometry::SnappedPoint, 3> corners_;
  int fraction_bits_;
  std::array<double, 3> values_;
  Extended slope_x_, slope_y_;
  double steep_x_, steep_y_;
  double largest_;
};

// The corners' depths as the host computes them, in units; the plane through them.
SnappedPlane depth_plane(const set_up::ScreenTriangle<double>& corners, int fraction_bits,
                         const set_up::WordFormat& format);

// The parameter that decides which pixels a machine covers.
const char* coverage_step(const run::Inputs::Content& machine);

// A pixel of the triangle, and its depth there in units of the depth word; of the span unit with the fraction bits
// below it.
using Visit = std::function<void(std::int64_t x, std::int64_t y, double depth)>;

class TriangleScreen {
 public:
  // Of the trial's machine; other steps than coverage and depth as they should be: EP1 carries on clock1, the start
  // edge on the lattice unless it is prestepped. The trial must outlive it.
  static std::unique_ptr<TriangleScreen> of(const Trial& trial);
  virtual ~TriangleScreen() = default;

  // `corners`: pixels, depth 0..1, inside the guard band of `grid`. +1: once snapped it faces the viewer, -1: it is
  // turned away, and drawn all the same; 0: it has no area, and nothing is drawn.
  virtual int draw(const set_up::ScreenTriangle<double>& corners, const geometry::SnapGrid& grid,
                   const Visit& visit) = 0;
  // Whether the snapped triangle is covered to the pixel. Else edges have scales of their own.
  virtual bool is_exact() const { return true; }

  // With the guard band, and where all of a frame is on the screen.
  virtual const geometry::SnapGrids& grids() const = 0;
  // Words of depth, and the screen.
  virtual const set_up::WordFormat& depth_format() const = 0;
  geometry::Viewport viewport() const { return {depth_format().columns, depth_format().lines}; }
  // How far the sides that are drawn may be from those of the corners as they are given, in pixels. The derivation
  // stands in configs/hard_cases/triangles_well_shaped.toml.
  virtual double displacement(const set_up::ScreenTriangle<double>& corners, const geometry::SnapGrid& grid) const;
  // Fraction bits of the corners through which planes are laid.
  virtual int plane_bits(const geometry::SnapGrid& grid) const { return grid.fraction_bits; }
  // The words of the normal's components, turned to the eye, where the machine interpolates normals;
  // set_up::normal_unit is 1.
  virtual std::optional<std::array<object_processor::LinearWords, 3>> normal_words(
      const set_up::ScreenTriangle<double>& /*corners*/, const geometry::SnapGrid& /*grid*/) const {
    return std::nullopt;
  }
  // How far a depth, or a component of a normal in its units, may be off the plane at a pixel of the triangle, in
  // units: rounding of the words, and of the doubles that they were computed in. The derivation stands in
  // configs/hard_cases/planes_well_shaped.toml.
  virtual double plane_bound(const SnappedPlane& plane, std::int64_t x, std::int64_t y) const = 0;
};

}  // namespace rastertlm::analysis
