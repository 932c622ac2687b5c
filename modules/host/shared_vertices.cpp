#include "modules/host/shared_vertices.h"

#include <map>
#include <set>
#include <utility>

namespace rastertlm::host {

SharedVertices::SharedVertices(const ResidentScene& scene) {
  for (const ResidentObject& resident : scene.objects) {
    Object& object = objects_.emplace_back();
    object.mesh = resident.mesh;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number_of;
    std::set<std::uint32_t> vertices;
    for (std::size_t t = 0; t < resident.mesh->triangles.size(); ++t) {
      auto& corners = object.corners.emplace_back();
      const auto material = static_cast<std::uint32_t>(resident.mesh->material[t]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = resident.mesh->triangles[t][i];
        const auto [use, is_new] =
            number_of.try_emplace({vertex, material}, static_cast<std::uint32_t>(object.uses.size()));
        if (is_new) object.uses.push_back({vertex, material});
        corners[i] = use->second;
        vertices.insert(vertex);
      }
    }
    object.levels.resize(object.uses.size());
    vertices_ += vertices.size();
  }
}

void SharedVertices::light(const geometry::Pose& pose, set_up::PointLighting& lighting) {
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    Object& object = objects_[o];
    for (std::size_t i = 0; i < object.uses.size(); ++i) {
      const auto& [vertex, material] = object.uses[i];
      set_up::LitPoint point;
      point.normal = pose.normal_to_eye[o] * object.mesh->normals[vertex];
      point.position = glm::dvec3(pose.object_to_eye[o] * glm::dvec4(object.mesh->positions[vertex], 1.0));
      object.levels[i] = lighting.levels(point, material);
    }
  }
}

std::array<SharedVertices::Levels, 3> SharedVertices::corners(std::size_t object, std::size_t triangle) const {
  const Object& of = objects_[object];
  const auto& [a, b, c] = of.corners[triangle];
  return {of.levels[a], of.levels[b], of.levels[c]};
}

}  // namespace rastertlm::host
