// Cuts triangles with highlights into smaller ones for Gouraud shading (003, section 3): regularly, by their area on
// the screen, or at the highlight's centre and along the edges that meet there. New corners on an edge are exactly on
// it, on a finer grid, so that whatever happens beside the edge no crack opens.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/set_up/highlight_search.h"
#include "modules/set_up/parameters.h"
#include "modules/set_up/point_lighting.h"

namespace rastertlm::set_up {

struct LitCorner {
  LitPoint point;
  PointLighting::Levels levels{0.0};
  double depth = 0.0;
};
using LitTriangle = std::array<LitCorner, 3>;

// What the tests of a highlight see of it, counting.
inline SurfacePoint<geometry::Counted<double>> surface_point(const LitPoint& point) {
  const auto of = [](const glm::dvec3& v) { return geometry::Vector3<geometry::Counted<double>>(v.x, v.y, v.z); };
  return {of(point.position), of(point.normal)};
}

struct SubdivisionCounts {
  std::uint64_t divided = 0;        // triangles of which there are several parts now
  std::uint64_t parts = 0;          // of these
  std::uint64_t centres = 0;        // of highlights found inside, a light
  std::uint64_t beside = 0;         // found outside: a corner is put on the edge that is nearest
  std::uint64_t unfound = 0;        // the search had no answer: not divided
  std::uint64_t inserted = 0;       // corners on edges, because the light is too far from linear there
  std::uint64_t at_limit = 0;       // not divided further, although it may have to be
  std::uint64_t at_grid_limit = 0;  // of them, because the grid of corners is not finer
  SubdivisionCounts& operator+=(const SubdivisionCounts& other);
};

class Subdivision {
 public:
  // `lighting` outlives it, and knows the frame's lights.
  Subdivision(const SetUpParameters& parameters, PointLighting& lighting);

  // Appends the parts of a triangle whose corners are lit, or itself. Positions are those of its corners in eye space
  // where a light or the viewer is at a point.
  void regular(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out);
  void highlight(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out);

  const SubdivisionCounts& counts() const { return counts_; }
  // Since the start of the run, light left out.
  const geometry::OperationCounts& operations() const { return operations_; }

 private:
  using Number = geometry::Counted<double>;
  struct Part {
    LitTriangle corners;
    int spare_bits = 0;  // of the grid, below those of its corners
  };

  void light(std::vector<LitCorner>& corners, std::uint32_t material);
  LitCorner between(const LitCorner& a, const LitCorner& b, std::int64_t share, int bits);
  LitCorner inside(const LitTriangle& corners, const std::array<double, 3>& weights, int bits);
  void lit(LitCorner& corner, std::uint32_t material);
  std::optional<FoundHighlight<Number>> search(const LitTriangle& corners, const HighlightSource& source);
  void for_lights_from(std::size_t light, const Part& part, std::uint32_t material, std::vector<LitTriangle>& out);
  void at_centre(const FoundHighlight<Number>& found, std::size_t light, const Part& part, std::uint32_t material,
                 std::vector<LitTriangle>& out);
  void on_edge(const FoundHighlight<Number>& found, std::size_t light, const Part& part, std::uint32_t material,
               std::vector<LitTriangle>& out);
  // `part`: its first corner is the bright one.
  void along_edges(std::size_t light, Part part, std::uint32_t material, std::vector<LitTriangle>& out);
  std::optional<LitCorner> inserted(const LitCorner& bright, const LitCorner& other, std::uint32_t material);

  SetUpParameters parameters_;
  PointLighting& lighting_;
  SubdivisionCounts counts_;
  geometry::OperationCounts operations_;
  std::vector<HighlightSource> sources_;  // of the triangle that is divided
  std::vector<LitCorner> grid_;
};

}  // namespace rastertlm::set_up
