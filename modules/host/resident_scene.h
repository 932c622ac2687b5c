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

// A triangle as a host processor holds it: three corners of position and normal, and a material, as 32-bit words.
inline constexpr std::uint64_t kResidentTriangleBytes = 4 * (3 * (3 + 3) + 1);

struct ResidentScene {
  std::vector<ResidentObject> objects;
  bool camera_moves = false;
  std::function<geometry::Pose(std::int64_t frame)> pose;  // the user's animation data (004, section 5.2.4)
};

}  // namespace rastertlm::host
