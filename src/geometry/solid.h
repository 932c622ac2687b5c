// A quadric cut by planes: what a host processor keeps resident of a solid.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace rastertlm::geometry {

// In its own space, x = (x, y, z, 1): the points with x^T quadric x <= 0 and dot(plane, x) <= 0 for every plane.
struct Solid {
  glm::dmat4 quadric{1.0};         // symmetric, its largest element about 1; more than 0 outside
  std::vector<glm::dvec4> planes;  // outwards, (x, y, z) of length 1
  std::uint16_t material = 0;      // an index of the scene's materials
};

}  // namespace rastertlm::geometry
