// Triangles that share vertices: what a host processor keeps resident of an object.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace rastertlm::geometry {

// Counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // one a position, unit length, outwards
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> material;  // one a triangle, an index of the scene's materials
  std::size_t degenerate = 0;  // of `triangles`, those whose corners coincide or are in line (they stay in the list)
  std::size_t left_out = 0;    // points and lines of a mesh file, which are not drawn
};

}  // namespace rastertlm::geometry
