#include "src/scene/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "src/base/child_process.h"
#include "src/base/errors.h"
#include "src/base/message.h"

namespace rastertlm::scene {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw InputError({path, 0, "", message});
}

// Remembers which files are opened: a glTF file names its buffers, an OBJ file its materials. What is no file, but a
// device or a pipe, might never end.
class WatchedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit WatchedFiles(std::set<std::string>& opened) : opened_(opened) {}
  bool Exists(const char* path) const override {  // assimp's own opens it
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (!Exists(path)) return nullptr;
    Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
    if (stream != nullptr) opened_.insert(path);
    return stream;
  }

 private:
  std::set<std::string>& opened_;
};

// assimp's glTF reader leaves faces out whose vertices do not exist, and says so in its log only.
class DroppedFaces {
 public:
  DroppedFaces() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Listener(any_), Assimp::Logger::Warn);  // the logger deletes it
  }
  ~DroppedFaces() { Assimp::DefaultLogger::kill(); }
  DroppedFaces(const DroppedFaces&) = delete;
  DroppedFaces& operator=(const DroppedFaces&) = delete;
  bool any() const { return any_; }

 private:
  class Listener : public Assimp::LogStream {
   public:
    explicit Listener(bool& heard) : heard_(heard) {}
    void write(const char* message) override {
      if (std::strstr(message, "out-of-range indices") != nullptr) heard_ = true;
    }

   private:
    bool& heard_;
  };
  bool any_ = false;
};

std::array<float, 3> triple(const aiVector3D& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void put_nodes(std::string& message, const aiNode& node, std::uint64_t parent, std::uint64_t& count) {
  const std::uint64_t own = count++;
  glm::dmat4 matrix;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      matrix[static_cast<int>(column)][static_cast<int>(row)] = static_cast<double>(node.mTransformation[row][column]);
  put(message, matrix);
  put(message, parent);
  put(message, std::vector<std::uint32_t>(node.mMeshes, node.mMeshes + node.mNumMeshes));
  for (unsigned i = 0; i < node.mNumChildren; ++i) put_nodes(message, *node.mChildren[i], own, count);
}

void put_part(std::string& message, const aiMesh& mesh) {
  put(message, static_cast<std::uint32_t>(mesh.mMaterialIndex));
  std::vector<std::array<float, 3>> positions, normals;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    positions.push_back(triple(mesh.mVertices[i]));
    if (mesh.HasNormals()) normals.push_back(triple(mesh.mNormals[i]));
  }
  std::vector<std::uint32_t> face_corners, corners;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    face_corners.push_back(face.mNumIndices);
    corners.insert(corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
  }
  put(message, positions);
  put(message, normals);
  put(message, face_corners);
  put(message, corners);
}

void put_material(std::string& message, const aiMaterial& material) {
  aiString name;
  const bool named = material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS;
  aiColor4D colour;
  const bool coloured = material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
                        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
  put(message, std::string(named ? name.C_Str() : ""));
  put(message, coloured);
  put(message, std::array<float, 3>{colour.r, colour.g, colour.b});
}

// A text that says what is wrong, or none and what was read.
std::string message_of(const std::string& path) {
  std::set<std::string> opened;
  Assimp::Importer importer;
  importer.SetIOHandler(new WatchedFiles(opened));  // the importer deletes it
  const DroppedFaces dropped;
  std::string message;
  // Polygons are triangulated by the importer of ours: assimp's own step stops at some damaged files.
  const aiScene* scene = importer.ReadFile(path, aiProcess_ValidateDataStructure);
  std::string mistake;
  if (scene == nullptr)
    mistake = fmt::format("is not a mesh that can be read: {}", importer.GetErrorString());
  else if (dropped.any())
    mistake = "a face names a vertex that does not exist";
  else if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0 || scene->mRootNode == nullptr || scene->mNumMeshes == 0)
    mistake = "has no triangle";
  put(message, mistake);
  if (!mistake.empty()) return message;
  std::string nodes;
  std::uint64_t node_count = 0;
  put_nodes(nodes, *scene->mRootNode, 0, node_count);
  put(message, node_count);
  message += nodes;
  put(message, static_cast<std::uint64_t>(scene->mNumMeshes));
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) put_part(message, *scene->mMeshes[i]);
  put(message, static_cast<std::uint64_t>(scene->mNumMaterials));
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) put_material(message, *scene->mMaterials[i]);
  put(message, static_cast<std::uint64_t>(opened.size()));
  for (const std::string& name : opened) put(message, name);
  return message;
}

MeshFile unpacked(Unpacker& unpacker) {
  const auto each = [&](const auto& take) {
    for (auto left = unpacker.number<std::uint64_t>(); left > 0; --left) take();
  };
  MeshFile file;
  each([&] {
    MeshFile::Node node;
    node.to_parent = unpacker.number<glm::dmat4>();
    node.parent = unpacker.number<std::uint64_t>();
    node.parts = unpacker.numbers<std::uint32_t>();
    file.nodes.push_back(std::move(node));
  });
  each([&] {
    MeshFile::Part part;
    part.material = unpacker.number<std::uint32_t>();
    part.positions = unpacker.numbers<std::array<float, 3>>();
    part.normals = unpacker.numbers<std::array<float, 3>>();
    part.face_corners = unpacker.numbers<std::uint32_t>();
    part.corners = unpacker.numbers<std::uint32_t>();
    file.parts.push_back(std::move(part));
  });
  each([&] {
    MeshFile::Colour material{unpacker.text(), std::nullopt};
    const bool coloured = unpacker.number<bool>();
    const auto colour = unpacker.number<std::array<float, 3>>();
    if (coloured) material.colour = colour;
    file.materials.push_back(std::move(material));
  });
  each([&] { file.opened.push_back(unpacker.text()); });
  return file;
}

// Whatever assimp has written over, it is bytes here.
MeshFile what_was_read(const std::string& path, const std::string& message) {
  try {
    Unpacker unpacker(message);
    const std::string mistake = unpacker.text();
    if (mistake.empty()) return unpacked(unpacker);
    refuse(path, mistake);
  } catch (const std::out_of_range&) {
    refuse(path, "is damaged: what was read of it makes no sense");
  }
}

// Far more than assimp takes for sound files: it reads some megabytes a second, in some ten times their memory.
ChildLimits limits_of(std::size_t bytes) {
  const auto size = static_cast<double>(bytes);
  return {5.0 + size / 50e3, (std::uint64_t{1} << 29) + 256 * static_cast<std::uint64_t>(bytes)};
}

}  // namespace

MeshFile read_mesh_file(const std::string& path, std::size_t bytes) {
  const ChildLimits limits = limits_of(bytes);
  const ChildOutcome outcome = in_child(limits, [&] { return message_of(path); });
  switch (outcome.end) {
    case ChildEnd::done:
      return what_was_read(path, outcome.bytes);
    case ChildEnd::out_of_time:
      refuse(path, fmt::format("is damaged: it was not read in {:.0f} s", limits.cpu_seconds));
    case ChildEnd::out_of_memory:
      refuse(path, fmt::format("is damaged: it cannot be read in {} MiB", limits.memory_bytes >> 20));
    case ChildEnd::stopped:
      break;
  }
  const std::string how = outcome.signal == 0 ? "" : fmt::format(" ({})", strsignal(outcome.signal));
  refuse(path, "is damaged: the library that reads meshes stopped at it" + how);
}

}  // namespace rastertlm::scene
