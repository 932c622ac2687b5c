// Meshes from corners: equal corners become one vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "src/scene/scene.h"

namespace rastertlm::scene {

// Finds points that are equal in every bit (0 and -0 are equal).
class PointIndex {
 public:
  // The number of `point`, counted from 0 in the order in which points were first seen.
  std::uint32_t find(const glm::dvec3& point);
  std::size_t size() const { return index_.size(); }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  std::unordered_map<Key, std::uint32_t, Hash> index_;
};

// Whether two corners coincide or all three are in line (|a x b| within 1e-14 of the square of the longest side).
bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

std::size_t count_degenerate(const Mesh& mesh);

// A normal for every position: the sum of its triangles' normals weighted by their angle there, over all triangles that
// have a corner at the same place, so that a mesh without shared vertices is smooth as well. Where they cancel, the
// first triangle's; (0, 0, 1) for a position that no triangle with an area uses.
std::vector<glm::dvec3> smooth_normals(const std::vector<glm::dvec3>& positions,
                                       const std::vector<std::array<std::uint32_t, 3>>& triangles);

// Corners with equal position and normal become one vertex; vertices that no triangle uses go. Order of first use.
void join_vertices(Mesh& mesh);

}  // namespace rastertlm::scene
