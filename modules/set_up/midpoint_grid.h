// Pseudo-Phong shading: a triangle as 4^k Gouraud triangles between the points of a grid, whose normals are made by
// halving edges k times. Each point is lit once, whoever shares it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/set_up/point_lighting.h"
#include "modules/set_up/subdivision.h"

namespace rastertlm::set_up {

class MidpointGrid {
 public:
  // `lighting` outlives it. `halvings`: k, 0..6.
  MidpointGrid(std::int64_t halvings, PointLighting& lighting);

  // Appends the parts of a triangle, whose corners run as its own do. It is lit, and on a grid that is finer by k bits
  // than its corners'.
  void cut(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out);

  // Depths between two points, in floating point; light is the lighting's.
  const geometry::OperationCounts& operations() const { return operations_; }

 private:
  std::size_t index(std::size_t i, std::size_t j) const { return j * (side_ + 1) - j * (j - 1) / 2 + i; }
  void halve(std::size_t step);
  void light(std::uint32_t material);

  PointLighting& lighting_;
  std::size_t side_;  // parts of an edge
  std::vector<LitCorner> points_;
  std::vector<LitPoint> unlit_;
  std::vector<PointLighting::Levels> levels_;
  geometry::OperationCounts operations_;
};

}  // namespace rastertlm::set_up
