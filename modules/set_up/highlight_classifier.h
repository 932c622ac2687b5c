// Which triangles of an object may hold a highlight's centre, and which are their neighbours (003, sections 2 and 3):
// found before any is drawn, in the object's own space.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "modules/set_up/highlight_test.h"
#include "src/geometry/counted.h"
#include "src/geometry/mesh.h"

namespace rastertlm::set_up {

// What a triangle is, once classified.
enum class Highlighted : std::uint8_t { no, potentially, neighbour };

struct ClassifiedCounts {
  std::uint64_t tested = 0;       // triangles
  std::uint64_t potentially = 0;  // highlighted: PHT
  std::uint64_t neighbours = 0;   // that are not PHT themselves
  ClassifiedCounts& operator+=(const ClassifiedCounts& other);
};

// Triangles that share a vertex: one of the same position, whatever its normal, so that a seam does not part them.
class Neighbourhood {
 public:
  explicit Neighbourhood(const geometry::Mesh& mesh);
  // Marks what shares a vertex with a triangle that is marked, `rings` times.
  void widen(std::int64_t rings, std::vector<Highlighted>& triangles) const;

 private:
  std::vector<std::array<std::uint32_t, 3>> corners_;  // of triangles, by distinct position
  std::uint32_t positions_ = 0;
};

// Lights and viewer of a frame, in eye space: the viewer is at the origin, or looks along -z from infinitely far.
struct EyeSources {
  std::span<const geometry::LightSource> lights;
  bool viewer_at_eye = false;
};

class HighlightClassifier {
 public:
  // The mesh outlives it. `surfaces`: the scene's materials; what reflects no specular light has no highlight.
  HighlightClassifier(const geometry::Mesh& mesh, std::span<const geometry::Reflectance> surfaces);

  // One mark a triangle. Where the matrix scales the object differently along its axes, angles are those of eye space
  // only: then vertices are taken there.
  const std::vector<Highlighted>& classify(const glm::dmat4& object_to_eye, const EyeSources& sources,
                                           std::int64_t rings);

  // Of the last frame.
  const ClassifiedCounts& counts() const { return counts_; }
  const geometry::OperationCounts& operations() const { return operations_; }

 private:
  void mark(std::span<const HighlightSource> sources, std::span<const glm::dvec3> positions,
            std::span<const glm::dvec3> normals);

  const geometry::Mesh& mesh_;
  Neighbourhood neighbourhood_;
  std::vector<std::uint8_t> shines_;  // of triangles
  std::vector<Highlighted> triangles_;
  std::vector<std::uint8_t> sides_;  // of vertices, one light
  std::vector<glm::dvec3> eye_positions_, eye_normals_;
  ClassifiedCounts counts_;
  geometry::OperationCounts operations_;
};

// Of `lights`, in the space into which `from_eye` leads.
std::vector<HighlightSource> highlight_sources(const EyeSources& sources, const glm::dmat4& from_eye);

}  // namespace rastertlm::set_up
