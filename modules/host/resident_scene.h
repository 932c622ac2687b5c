// What the host processors know of a scene: the meshes and solids that are resident in their memories, what of them can
// move, and where everything stands at a frame. Whoever assembles the machine makes it from the scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "src/geometry/mesh.h"
#include "src/geometry/pose.h"
#include "src/geometry/solid.h"

namespace rastertlm::host {

struct ResidentObject {
  const geometry::Mesh* mesh = nullptr;  // of no triangle where it is a solid
  bool two_sided = false;
  bool moves = false;
  const geometry::Solid* solid = nullptr;
};

// Objects of the machine, a processor each: a mesh's triangles, or a solid.
inline std::uint32_t machine_objects(const ResidentObject& object) {
  return object.solid != nullptr ? 1 : static_cast<std::uint32_t>(object.mesh->triangles.size());
}

// A triangle as a host processor holds it: three corners of position and normal, and a material, as 32-bit words.
inline constexpr std::uint64_t kResidentTriangleBytes = 4 * (3 * (3 + 3) + 1);

// A solid: the ten elements of its symmetric matrix, four of each plane, and a material.
inline std::uint64_t resident_bytes(const geometry::Solid& solid) { return 4 * (10 + 4 * solid.planes.size() + 1); }

struct ResidentScene {
  std::vector<ResidentObject> objects;
  bool camera_moves = false;
  std::function<geometry::Pose(std::int64_t frame)> pose;  // the user's animation data (004, section 5.2.4)
};

}  // namespace rastertlm::host
