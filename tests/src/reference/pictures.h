// Scenes and poses made by hand for the tests of the exact renderers.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "src/geometry/snapping.h"
#include "src/reference/renderer.h"
#include "src/scene/scene.h"

namespace rastertlm::reference::testing_support {

struct Picture {
  scene::Scene scene;
  scene::Pose pose;
  RenderOptions options;

  Picture(std::size_t columns, std::size_t lines, int snap_limit = -1) {
    options.columns = columns;
    options.lines = lines;
    options.grids = geometry::snap_grids(columns, lines, 24, snap_limit).value();
    scene.materials.push_back({"grey", glm::dvec3(1.0), 0.1, 0.5, 0.4, 4});
  }

  // Eye space in pixels: (x, -y) is the sample of pixel (x, y), and -100 z the depth.
  void look_at_pixels() {
    const auto columns = static_cast<double>(options.columns);
    const auto lines = static_cast<double>(options.lines);
    scene.camera.projection = scene::ProjectionKind::orthographic;
    pose.eye_to_clip = glm::orthoRH_ZO(-0.5, columns - 0.5, -(lines - 0.5), 0.5, 0.0, 100.0);
  }
  void look_in_perspective() {
    scene.camera.projection = scene::ProjectionKind::perspective;
    const double aspect = static_cast<double>(options.columns) / static_cast<double>(options.lines);
    pose.eye_to_clip = glm::perspectiveRH_ZO(0.7, aspect, 1.0, 50.0);
  }
  void add_light(const scene::Light& light) { pose.lights.push_back(light); }

  scene::Mesh& add_object(bool two_sided = false) {
    scene.objects.emplace_back();
    scene.objects.back().two_sided = two_sided;
    pose.object_to_eye.emplace_back(1.0);
    pose.normal_to_eye.emplace_back(1.0);
    return scene.objects.back().mesh;
  }
  frame::ExactFrame render_as(Reference kind) {
    options.kind = kind;
    return render(scene, pose, options);
  }
};

inline void add_triangle(scene::Mesh& mesh, const std::array<glm::dvec3, 3>& positions,
                         const std::array<glm::dvec3, 3>& normals, std::uint16_t material = 0) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
  mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.material.push_back(material);
}

inline constexpr glm::dvec3 kToEye{0, 0, 1};

inline void add_flat_triangle(scene::Mesh& mesh, const std::array<glm::dvec3, 3>& positions) {
  add_triangle(mesh, positions, {kToEye, kToEye, kToEye});
}

// The same numbers everywhere, unlike the standard's distributions.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  glm::dvec3 normal() { return glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(0.1, 1))); }

 private:
  std::mt19937 engine_;
};

}  // namespace rastertlm::reference::testing_support
