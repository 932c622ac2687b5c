// Colours triangles for a span unit (000/001, sections 3 and 4): light at their points, the interpolation's
// coefficients, and, where the method tests for highlights, children where the quadratic is too far off.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "modules/set_up/midpoint_grid.h"
#include "modules/set_up/parameters.h"
#include "modules/set_up/point_lighting.h"
#include "modules/set_up/span_load.h"
#include "modules/set_up/stitching.h"
#include "modules/set_up/subdivision.h"

namespace rastertlm::set_up {

// What became of a frame's triangles.
struct ColourCounts {
  std::uint64_t drawn = 0;  // pieces handed to the span unit, children counted one by one
  std::uint64_t back_faces = 0;
  std::uint64_t degenerate = 0;      // no area once on the grid: dropped
  std::uint64_t flat_low = 0;        // lower than 1/64 pixel: drawn in the mean of its corners' colours
  std::uint64_t flat_undefined = 0;  // the solver or its numbers had no answer: likewise
  std::uint64_t splits = 0;          // triangles replaced by four
  std::uint64_t at_limit = 0;        // to be split by the test, and not split any more
  std::uint64_t tests = 0;           // light evaluated to test
  ColourCounts& operator+=(const ColourCounts& other);
};

struct ColourRequest {
  std::array<LitPoint, 3> corners;  // counter-clockwise to the eye where it faces it
  std::array<double, 3> depth{};    // in units of the depth word
  std::uint32_t object = 0;         // from 1
  std::uint32_t material = 0;
  bool two_sided = false;
  bool by_pixels = false;    // a pixel unit lights it: it gets no colours
  bool highlighted = false;  // may hold a highlight, or lies beside what may (003)
  // Light at the corners of its front, where it is known: then it is not evaluated. Of linear methods.
  const std::array<PointLighting::Levels, 3>* lit = nullptr;
};

class TriangleColourer {
 public:
  // `lighting` outlives it.
  TriangleColourer(const SetUpParameters& parameters, PointLighting& lighting);

  // Where the machine stitches, before any triangle of a frame is coloured: what may hold a highlight is cut up, so
  // that what lies beside it is known. What was cut is not cut again.
  void begin_frame();
  void cut(const ColourRequest& request);

  // Appends what is to be drawn, nothing where the triangle is dropped.
  void colour(const ColourRequest& request, std::vector<ColourTriangle>& out);

  const ColourCounts& counts() const { return counts_; }
  const SubdivisionCounts& subdivision() const { return subdivision_.counts(); }
  const StitchCounts& stitched() const { return stitching_.counts(); }
  // Operations since the start of the run, light included.
  geometry::OperationCounts operations() const;

 private:
  using Levels = PointLighting::Levels;
  struct Knot {
    LitPoint point;
    Levels levels{0.0};
  };
  // Corners 1, 2, 3, then the middles of 1-2, 1-3, 2-3.
  static constexpr std::size_t kKnots = 6;
  struct Knots {
    std::array<LitPoint, kKnots> point;
    std::array<Levels, kKnots> levels;
    Knot knot(std::size_t i) const { return {point[i], levels[i]}; }
  };
  static Knots together(const std::array<Knot, kKnots>& knots);

  void begin_triangle(const ColourRequest& request, const std::array<double, 3>& depth,
                      std::vector<ColourTriangle>& out) const;
  bool is_dropped(const ColourRequest& request, bool& turned);
  CutTriangle lit_whole(const ColourRequest& request, bool turned);
  CutTriangle cut_up(const ColourRequest& request, bool turned);
  CutTriangle* find_cut(const ColourRequest& request);
  void draw_stitched(const ColourRequest& request, bool turned, std::vector<ColourTriangle>& out);
  void draw_parts(const ColourRequest& request, const std::vector<LitTriangle>& parts,
                  std::vector<ColourTriangle>& out);
  void light_knots(const ColourRequest& request, bool turned, Knots& knots);
  Knot knot_of(const LitPoint& point, std::uint32_t material);
  Knot between(const Knot& a, const Knot& b, std::uint32_t material);
  // `out` ends with the triangle, of which corners and colour are missing.
  void split_or_draw(const Knots& knots, int level, std::vector<ColourTriangle>& out);
  void split(const Knots& knots, int level, std::vector<ColourTriangle>& out);
  bool is_to_split(const Knots& knots, const ColourTriangle& triangle);
  bool may_hold_highlight(const Knots& knots, std::uint32_t material);
  bool is_off(const Knots& knots, const ColourTriangle& triangle, std::uint32_t material);
  bool is_off_at(const Knots& knots, const ColourTriangle& triangle, std::uint32_t material,
                 const std::array<double, 3>& weights);
  void solve_linear(const Knots& knots, ColourTriangle& triangle);
  void solve_quadratic(const Knots& knots, ColourTriangle& triangle);
  void draw_flat(const Knots& knots, ColourTriangle& triangle) const;
  bool is_low(const ColourTriangle& triangle) const;
  geometry::SnappedPoint child_corner(const geometry::SnappedPoint& exact) const;

  SetUpParameters parameters_;
  PointLighting& lighting_;
  Subdivision subdivision_;
  MidpointGrid midpoints_;
  Stitching stitching_;
  std::unordered_map<std::uint32_t, std::vector<CutTriangle>> cuts_;  // of a frame, by the scene's triangle
  ColourCounts counts_;
  geometry::OperationCounts operations_;
  geometry::OperationCounts solve_cost_;  // three channels
  geometry::OperationCounts facing_cost_;
  geometry::OperationCounts test_cost_;  // one point, without its light
  Knots knots_;                          // of the last triangle that was given
};

}  // namespace rastertlm::set_up
