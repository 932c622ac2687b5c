#include "src/scene/mesh_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "src/base/mathematics.h"

namespace rastertlm::scene {
namespace {

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }  // -0 + 0 is +0

}  // namespace

std::size_t PointIndex::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const std::uint64_t word : key) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdULL;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

std::uint32_t PointIndex::find(const glm::dvec3& point) {
  const auto next = static_cast<std::uint32_t>(index_.size());
  return index_.try_emplace(Key{bits(point.x), bits(point.y), bits(point.z)}, next).first->second;
}

bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 bc = c - b;
  const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  return !(glm::length(glm::cross(ab, ac)) > 1e-14 * longest);
}

std::size_t count_degenerate(const Mesh& mesh) {
  std::size_t count = 0;
  for (const auto& t : mesh.triangles)
    if (is_degenerate(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]])) ++count;
  return count;
}

std::vector<glm::dvec3> smooth_normals(const std::vector<glm::dvec3>& positions,
                                       const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  PointIndex places;
  std::vector<std::uint32_t> place(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) place[i] = places.find(positions[i]);
  std::vector<glm::dvec3> sums(places.size(), glm::dvec3(0.0));
  std::vector<glm::dvec3> first(places.size(), glm::dvec3(0.0, 0.0, 1.0));
  std::vector<bool> seen(places.size(), false);
  for (const auto& t : triangles) {
    const std::array<glm::dvec3, 3> p{positions[t[0]], positions[t[1]], positions[t[2]]};
    if (is_degenerate(p[0], p[1], p[2])) continue;
    const glm::dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::dvec3 a = p[(corner + 1) % 3] - p[corner];
      const glm::dvec3 b = p[(corner + 2) % 3] - p[corner];
      const std::uint32_t at = place[t[corner]];
      sums[at] += mathematics::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * normal;
      if (!seen[at]) first[at] = normal;
      seen[at] = true;
    }
  }
  std::vector<glm::dvec3> normals(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 sum = sums[place[i]];
    normals[i] = glm::length(sum) > 1e-6 ? glm::normalize(sum) : first[place[i]];
  }
  return normals;
}

void join_vertices(Mesh& mesh) {
  PointIndex places;
  PointIndex directions;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> vertices;
  Mesh joined;
  for (auto triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      const glm::dvec3 position = mesh.positions[corner];
      const glm::dvec3 normal = mesh.normals[corner];
      const auto next = static_cast<std::uint32_t>(joined.positions.size());
      const auto [entry, fresh] = vertices.try_emplace({places.find(position), directions.find(normal)}, next);
      if (fresh) {
        joined.positions.push_back(position);
        joined.normals.push_back(normal);
      }
      corner = entry->second;
    }
    joined.triangles.push_back(triangle);
  }
  mesh.positions = std::move(joined.positions);
  mesh.normals = std::move(joined.normals);
  mesh.triangles = std::move(joined.triangles);
}

}  // namespace rastertlm::scene
