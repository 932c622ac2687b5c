// Questions about meshes that more than one test asks.
#pragma once

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "src/scene/scene.h"

namespace rastertlm::scene::testing {

using Point = std::tuple<double, double, double>;
using Edge = std::pair<Point, Point>;

inline Point point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

// How often each directed edge occurs, by position. Triangles with two equal corners have none.
inline std::map<Edge, int> directed_edges(const Mesh& mesh) {
  std::map<Edge, int> edges;
  for (const auto& t : mesh.triangles) {
    const std::array<Point, 3> p{point(mesh.positions[t[0]]), point(mesh.positions[t[1]]), point(mesh.positions[t[2]])};
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) ++edges[{p[i], p[(i + 1) % 3]}];
  }
  return edges;
}

struct Seams {
  std::size_t open = 0;      // edges without a partner in the opposite direction
  std::size_t repeated = 0;  // directed edges that occur more than once
  std::size_t edges = 0;     // undirected
};

inline Seams seams(const Mesh& mesh) {
  const auto edges = directed_edges(mesh);
  Seams result;
  std::size_t paired = 0;
  for (const auto& [edge, count] : edges) {
    if (count != 1) ++result.repeated;
    if (edges.count({edge.second, edge.first}) == 0) {
      ++result.open;
    } else {
      ++paired;
    }
  }
  result.edges = paired / 2 + result.open;
  return result;
}

inline std::size_t places(const Mesh& mesh) {
  std::set<Point> all;
  for (const auto& t : mesh.triangles)
    for (const auto corner : t) all.insert(point(mesh.positions[corner]));
  return all.size();
}

// Of the body between the mesh and the origin: the volume, where the mesh is closed.
inline double signed_volume(const Mesh& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles)
    six += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  return six / 6.0;
}

// The smallest cosine between a triangle's own normal and those of its corners, over triangles with an area.
inline double worst_agreement(const Mesh& mesh) {
  double worst = 1.0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 face =
        glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    if (glm::length(face) < 1e-12) continue;
    for (const auto corner : t) worst = std::min(worst, glm::dot(glm::normalize(face), mesh.normals[corner]));
  }
  return worst;
}

inline double worst_length_error(const Mesh& mesh) {
  double worst = 0.0;
  for (const auto& n : mesh.normals) worst = std::max(worst, std::abs(glm::length(n) - 1.0));
  return worst;
}

}  // namespace rastertlm::scene::testing
