// The vertices of a scene's meshes as a host lights them that knows which triangles share one: once a frame, each with
// every material that meets there, whether it is seen or not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/host/resident_scene.h"
#include "modules/set_up/point_lighting.h"
#include "src/geometry/mesh.h"
#include "src/geometry/pose.h"

namespace rastertlm::host {

class SharedVertices {
 public:
  using Levels = set_up::PointLighting::Levels;

  // The scene's meshes outlive it.
  explicit SharedVertices(const ResidentScene& scene);

  // Of a frame, whose lights `lighting` knows; operations are counted there.
  void light(const geometry::Pose& pose, set_up::PointLighting& lighting);

  // Vertices that some triangle of the scene has.
  std::size_t size() const { return vertices_; }
  std::array<Levels, 3> corners(std::size_t object, std::size_t triangle) const;

 private:
  struct Use {
    std::uint32_t vertex = 0;
    std::uint32_t material = 0;
  };
  struct Object {
    const geometry::Mesh* mesh = nullptr;
    std::vector<Use> uses;
    std::vector<std::array<std::uint32_t, 3>> corners;  // of triangles, by use
    std::vector<Levels> levels;                         // of uses
  };
  std::vector<Object> objects_;
  std::size_t vertices_ = 0;
};

}  // namespace rastertlm::host
