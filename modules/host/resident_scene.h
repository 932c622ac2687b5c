// What the host processors know of a scene: the meshes that are resident in their memories, what of them can move, and
// where everything stands at a frame. Whoever assembles the machine makes it from the scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "src/geometry/mesh.h"
#include "src/geometry/pose.h"

namespace rastertlm::host {

struct ResidentObject {
  const geometry::Mesh* mesh = nullptr;
  bool two_sided = false;
  bool moves = false;
};

struct ResidentScene {
  std::vector<ResidentObject> objects;
  bool camera_moves = false;
  std::function<geometry::Pose(std::int64_t frame)> pose;  // the user's animation data (004, section 5.2.4)
};

}  // namespace rastertlm::host
