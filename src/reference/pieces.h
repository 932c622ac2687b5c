// The triangles of a frame, clipped and on the screen.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "src/geometry/frame_grid.h"
#include "src/reference/renderer.h"

namespace rastertlm::reference {

// A piece of a triangle, its corners clockwise as seen.
struct Piece {
  std::uint32_t object = 0;                                 // number of the triangle, from 1
  std::uint16_t material = 0;                               // an index of Scene::materials
  std::array<geometry::ScreenVertex<double>, 3> corners{};  // normals towards the viewer's side, not of unit length
  std::array<geometry::SnappedPoint, 3> snapped{};          // Reference::snapped only
  std::array<glm::dvec3, 3> eye_positions{};                // Reference::true_model, or with lights at points
};

struct Pieces {
  std::vector<Piece> list;  // in the order of their numbers
  geometry::FrameGrid grid;
};

Pieces pieces(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options);

}  // namespace rastertlm::reference
