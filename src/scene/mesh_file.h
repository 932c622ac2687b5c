// What a mesh file holds, as assimp tells it: nothing of it is checked yet.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rastertlm::scene {

struct MeshFile {
  struct Node {
    glm::dmat4 to_parent{1.0};
    std::uint64_t parent = 0;  // its place in `nodes`, before its own; the first has none
    std::vector<std::uint32_t> parts;
  };
  struct Part {
    std::uint32_t material = 0;
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<float, 3>> normals;  // none, or one a position
    std::vector<std::uint32_t> face_corners;    // of each face: how many
    std::vector<std::uint32_t> corners;         // of all faces: positions
  };
  struct Colour {
    std::string name;
    std::optional<std::array<float, 3>> colour;
  };
  std::vector<Node> nodes;
  std::vector<Part> parts;
  std::vector<Colour> materials;
  std::vector<std::string> opened;  // every file that was read, each once, in order of their names
};

// Reads with assimp, in a process of its own: there are files of every format of which assimp 5.2.5 reads or writes
// beyond its memory, or that it reads for ever. `bytes`: the file's size. Throws InputError, naming the file: it is no
// mesh, or reading it was stopped by a fault, or went on beyond a time or memory that no sound file of that size needs.
MeshFile read_mesh_file(const std::string& path, std::size_t bytes);

}  // namespace rastertlm::scene
