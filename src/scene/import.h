// Mesh files, read through assimp.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace rastertlm::scene {

struct ImportedMesh {
  Mesh mesh;  // Mesh::material counts in `materials`
  std::vector<Material>
      materials;       // of the file, named "<file name>:<material>"; empty where the file has none of its own
  std::string digest;  // of the file's bytes and of those of every file that it refers to
};

// Reads OBJ, PLY, STL, glTF 2 (.gltf, .glb) and whatever else assimp reads, in the file's own axes. Node transforms are
// applied; polygons are triangulated; points and lines are left out and counted in Mesh::left_out. Normals are the
// file's; where it has none, and for STL (which has one a facet), they are computed smooth over joined vertices. Throws
// InputError, naming the file: missing, empty, not a mesh, a vertex that is not finite, a face that names a vertex that
// does not exist, no triangle, more than 2^24 vertices, damage that stops assimp (which reads in a process of its own).
ImportedMesh import_mesh(const std::string& path);

}  // namespace rastertlm::scene
