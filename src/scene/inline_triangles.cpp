#include "src/scene/inline_triangles.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "src/scene/check.h"
#include "src/scene/mesh_builder.h"

namespace rastertlm::scene {
namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

bool within_reach(const Triple& t) {
  for (const double coordinate : t)
    if (std::isfinite(coordinate) && std::fabs(coordinate) > kFarthest)
      return false;  // what is not finite is reported by check()
  return true;
}

void check_counts(const ObjectDescription& object, const std::string& path, Problems& problems) {
  const std::size_t count = object.positions.size();
  if (count == 0) problems.add(path + ".positions", "has no position");
  if (object.indices.empty() && count % 3 != 0)
    problems.add(path + ".positions", fmt::format("{} positions without indices are not three a triangle", count));
  if (!object.normals.empty() && object.normals.size() != count)
    problems.add(path + ".normals", fmt::format("{} normals for {} positions: give one a position, or none",
                                                object.normals.size(), count));
}

void check_entries(const ObjectDescription& object, const std::string& path, Problems& problems) {
  const auto count = static_cast<std::int64_t>(object.positions.size());
  for (std::size_t i = 0; i < object.indices.size(); ++i)
    for (const std::int64_t index : object.indices[i])
      if (index < 0 || index >= count)
        problems.add(fmt::format("{}.indices[{}]", path, i),
                     fmt::format("position {} does not exist: there are {}, counted from 0", index, count));
  for (std::size_t i = 0; i < object.normals.size(); ++i)
    if (!has_length(object.normals[i])) problems.add(fmt::format("{}.normals[{}]", path, i), "has no length");
  for (std::size_t i = 0; i < object.positions.size(); ++i)
    if (!within_reach(object.positions[i]))
      problems.add(fmt::format("{}.positions[{}]", path, i), fmt::format("lies beyond {}", kFarthest));
}

}  // namespace

Mesh inline_triangles(const ObjectDescription& object, const std::string& path, Problems& problems) {
  const std::size_t before = problems.count();
  check_counts(object, path, problems);
  check_entries(object, path, problems);
  Mesh mesh;
  if (problems.count() != before) return mesh;
  for (const Triple& position : object.positions) mesh.positions.push_back(vector(position));
  for (const IndexTriple& t : object.indices)
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2])});
  if (object.indices.empty())
    for (std::uint32_t i = 0; i + 2 < object.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  for (const Triple& normal : object.normals) mesh.normals.push_back(glm::normalize(vector(normal)));
  if (mesh.normals.empty()) mesh.normals = smooth_normals(mesh.positions, mesh.triangles);
  join_vertices(mesh);
  mesh.degenerate = count_degenerate(mesh);
  return mesh;
}

}  // namespace rastertlm::scene
