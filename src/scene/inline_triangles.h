// Triangles that the scene file itself holds.
#pragma once

#include <string>

#include "src/scene/problems.h"
#include "src/scene/scene.h"

namespace rastertlm::scene {

// Normals are the file's, brought to length 1, or smooth ones where it gives none. What is wrong (a count, an index, a
// normal without length) goes to `problems` under the object's path, and the mesh is then empty.
Mesh inline_triangles(const ObjectDescription& object, const std::string& path, Problems& problems);

}  // namespace rastertlm::scene
