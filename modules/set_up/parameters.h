// How the set-up processor of a span unit's machine colours triangles: declared once, here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/set_up/quadratic_solver.h"
#include "src/base/errors.h"
#include "src/base/shading_method.h"
#include "src/parameter/table.h"

namespace rastertlm::set_up {

enum class SetUpArithmetic { double_precision, single_precision, fixed };
// What a light sees of a point half way between two corners on the screen. linear: normals (and positions, for lights
// at points) linear on the screen, the viewer infinitely far. perspective: those of the surface at that point, the
// viewer at the eye.
enum class Attributes { linear, perspective };
// What a triangle is split by: the quadratic's error at one point or at four, or H1 and H2 at its corners (003).
enum class TestPoints { centroid, points, h1h2 };
// Corners of children: exact midpoints of their parent's, or midpoints moved to the grid of all vertices.
enum class ChildCoverage { parent, snapped };

// What is computed once: a corner of each triangle, or a vertex of the mesh, whichever triangles share it.
enum class Vertices { corners, shared };

struct SetUpParameters {
  ShadingMethod method = ShadingMethod::quadratic;
  Solver solver = Solver::barycentric;
  SetUpArithmetic arithmetic = SetUpArithmetic::double_precision;
  std::int64_t fixed_fraction_bits = 40;
  Attributes attributes = Attributes::linear;
  bool clamp_knots = true;
  std::int64_t snap_bits = 4;
  double test_threshold_levels = 4.0;
  TestPoints test_points = TestPoints::centroid;
  std::int64_t test_depth_limit = 4;
  ChildCoverage child_coverage = ChildCoverage::parent;
  // Of the methods of 003:
  Vertices vertices = Vertices::corners;
  std::int64_t rings = 1;        // of neighbours of triangles that may hold a highlight
  std::int64_t refinements = 2;  // of its centre: H1 and H2 in turns
  double area_pixels = 32.0;     // regular subdivision goes on above it
  double intensity_error = 0.3;  // relative: highlight subdivision puts a vertex on an edge above it
  std::int64_t depth_limit = 6;  // of subdivision
  bool stitch = false;           // corners on edges are given to what lies beside them
  std::int64_t halvings = 2;     // pseudo-Phong: of every edge

  // Paths "set_up.method" ..., "highlight_test.threshold_levels" ..., "subdivision.coverage", "pseudo_phong.depth"
  void declare(parameter::Table& table);
  // The paths of a machine that shades as 003 does: "highlight_test.rings" ..., "subdivision.area_pixels" ...
  void declare_adaptive(parameter::Table& table);
  // A fixed format that the program has not, a method that other platforms offer.
  void check(const std::string& file, Diagnostics& diagnostics) const;
  void check_method(const std::string& platform, const std::string& file, Diagnostics& diagnostics) const;

  // Colours are linear on what is drawn.
  bool linear() const { return method != ShadingMethod::quadratic && method != ShadingMethod::quadratic_adaptive; }
  // Cut up where a highlight may be, as 003 does.
  bool subdivides() const {
    return method == ShadingMethod::regular_subdivision || method == ShadingMethod::highlight_subdivision;
  }
  // Triangles get the corners that those beside them have on common edges.
  bool stitches() const { return stitch && subdivides(); }
  // Triangles are told apart before any is drawn.
  bool classifies() const { return subdivides() || method == ShadingMethod::gouraud_phong; }
  // Rings of neighbours that are treated alike. A highlight is cut at its centre, which neighbours have none of.
  std::int64_t rings_treated() const { return method == ShadingMethod::highlight_subdivision ? 0 : rings; }
  // Some triangles' pixels, or all, are shaded one by one: the machine has a pixel unit.
  bool shades_some_pixels() const { return method == ShadingMethod::gouraud_phong || shades_pixels(method); }
  // Triangles are cut into parts whose corners are on a finer grid.
  bool makes_parts() const { return subdivides() || method == ShadingMethod::quadratic_adaptive; }

  // Fraction bits of corners: those of the grid, and one for every time that a triangle may be split.
  int corner_bits() const;

 private:
  void declare_common(parameter::Table& table);
};

// Fraction bits that FixedNumber is compiled for.
const std::vector<std::int64_t>& fixed_formats();

}  // namespace rastertlm::set_up
