// The triangles of a frame, clipped and on the screen.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "src/geometry/frame_grid.h"
#include "src/reference/renderer.h"

namespace rastertlm::reference {

// A piece of a triangle, its corners clockwise as seen.
struct Piece {
  std::uint32_t object = 0;                                 // number of the triangle among what is drawn, from 1
  std::uint16_t material = 0;                               // an index of Scene::materials
  std::uint32_t body = 0;                                   // an index of Scene::objects
  std::array<geometry::ScreenVertex<double>, 3> corners{};  // normals towards the viewer's side, not of unit length
  std::array<geometry::SnappedPoint, 3> snapped{};          // Reference::snapped only
  std::array<glm::dvec3, 3> eye_positions{};                // Reference::true_model, or with lights at points
};

struct Pieces {
  std::vector<Piece> list;  // in the order of their numbers
  geometry::FrameGrid grid;
};

Pieces pieces(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options);

// A piece before it is known whether it is seen, for who compares how a machine and the exact picture decide that:
// corners in the order of their triangle, normals as they come; `snapped` is set whatever the kind.
struct CutPiece {
  Piece piece;
  bool two_sided = false;
};
struct CutPieces {
  std::vector<CutPiece> list;  // likewise; those of pieces(), in its order, and those that it leaves out
  geometry::FrameGrid grid;
};
CutPieces cut_pieces(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options);

// As it is seen, decided on the snapped corners or on those that are not; nothing where it faces away and is not
// two-sided, or has no area.
std::optional<Piece> as_seen(const CutPiece& cut, bool by_snapped);

}  // namespace rastertlm::reference
