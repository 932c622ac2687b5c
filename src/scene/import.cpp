#include "src/scene/import.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "src/base/digest.h"
#include "src/base/errors.h"
#include "src/scene/mesh_builder.h"
#include "src/scene/transform.h"
#include "src/scene/triangulate.h"

namespace rastertlm::scene {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw InputError({path, 0, "", message});
}

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Remembers which files are opened: a glTF file names its buffers, an OBJ file its materials.
class WatchedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit WatchedFiles(std::set<std::string>& opened) : opened_(opened) {}
  Assimp::IOStream* Open(const char* path, const char* mode) override {
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

std::string digest_of(const std::string& path, const std::string& bytes, std::set<std::string> opened) {
  std::string text = sha256_hex(bytes);
  opened.erase(path);
  for (const std::string& other : opened) text += '\n' + sha256_hex(read_bytes(other));
  return sha256_hex(text);
}

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
  glm::dmat4 result;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      result[static_cast<int>(column)][static_cast<int>(row)] = static_cast<double>(m[row][column]);
  return result;
}

glm::dvec3 vector_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// One file while it is being read.
class Reading {
 public:
  Reading(const std::string& path, const aiScene& scene, bool facet_normals)
      : path_(path), scene_(scene), facet_normals_(facet_normals) {}

  ImportedMesh run() {
    add_node(*scene_.mRootNode, glm::dmat4(1.0));
    if (result_.mesh.triangles.empty()) refuse(path_, "has no triangle");
    fill_normals();
    join_vertices(result_.mesh);
    result_.mesh.degenerate = count_degenerate(result_.mesh);
    if (!own_material_) result_.materials.clear();
    return std::move(result_);
  }

 private:
  void add_node(const aiNode& node, const glm::dmat4& parent) {
    const glm::dmat4 to_file = parent * matrix_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) refuse(path_, "a node names a mesh that does not exist");
      add_mesh(*scene_.mMeshes[node.mMeshes[i]], to_file);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], to_file);
  }

  void add_mesh(const aiMesh& mesh, const glm::dmat4& to_file) {
    Mesh& out = result_.mesh;
    const std::size_t base = out.positions.size();
    if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
      refuse(path_, "has more than 2^32 vertices");
    const glm::dmat3 linear(to_file);
    const glm::dmat3 for_normals = inverse_transpose(linear);
    const bool mirrored = glm::dot(linear[0], glm::cross(linear[1], linear[2])) < 0.0;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const glm::dvec3 position(to_file * glm::dvec4(vector_of(mesh.mVertices[i]), 1.0));
      if (!is_finite(position)) refuse(path_, fmt::format("vertex {} is not finite", base + i));
      out.positions.push_back(position);
      out.normals.push_back(mesh.HasNormals() && !facet_normals_ ? for_normals * vector_of(mesh.mNormals[i])
                                                                 : glm::dvec3(0.0));
      if (!is_finite(out.normals.back())) refuse(path_, fmt::format("the normal of vertex {} is not finite", base + i));
    }
    const std::uint16_t material = material_of(mesh.mMaterialIndex);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) add_face(mesh.mFaces[i], mesh.mNumVertices, base, mirrored, material);
  }

  void add_face(const aiFace& face, unsigned vertices, std::size_t base, bool mirrored, std::uint16_t material) {
    for (unsigned corner = 0; corner < face.mNumIndices; ++corner)
      if (face.mIndices[corner] >= vertices)
        refuse(path_, fmt::format("a face names vertex {}: there are {}", face.mIndices[corner], vertices));
    if (face.mNumIndices == 0) refuse(path_, "a face has no corner: the file is damaged or cut short");
    if (face.mNumIndices < 3) {
      ++result_.mesh.left_out;
      return;
    }
    std::vector<glm::dvec3> corners;
    for (unsigned corner = 0; corner < face.mNumIndices; ++corner)
      corners.push_back(result_.mesh.positions[base + face.mIndices[corner]]);
    const auto at = [&](std::uint32_t corner) { return static_cast<std::uint32_t>(base + face.mIndices[corner]); };
    for (const auto& t : triangulate(corners)) {
      result_.mesh.triangles.push_back({at(t[0]), at(t[mirrored ? 2 : 1]), at(t[mirrored ? 1 : 2])});
      result_.mesh.material.push_back(material);
    }
  }

  // Unit length; where the file has none, or one without length, the smooth one.
  void fill_normals() {
    Mesh& mesh = result_.mesh;
    std::vector<glm::dvec3> smooth;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
      const double length = glm::length(mesh.normals[i]);
      if (length > 1e-30 && std::isfinite(length)) {
        mesh.normals[i] = mesh.normals[i] / length;
        continue;
      }
      if (smooth.empty()) smooth = smooth_normals(mesh.positions, mesh.triangles);
      mesh.normals[i] = smooth[i];
    }
  }

  std::uint16_t material_of(unsigned index) {
    const auto [entry, fresh] = materials_.try_emplace(index, static_cast<std::uint16_t>(result_.materials.size()));
    if (!fresh) return entry->second;
    if (result_.materials.size() >= std::numeric_limits<std::uint16_t>::max()) refuse(path_, "has too many materials");
    Material material;
    std::string name;
    if (index < scene_.mNumMaterials) {
      const aiMaterial& source = *scene_.mMaterials[index];
      aiString text;
      if (source.Get(AI_MATKEY_NAME, text) == aiReturn_SUCCESS) name = text.C_Str();
      aiColor4D colour;
      if (source.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
          source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
        material.colour = glm::dvec3(fraction(colour.r), fraction(colour.g), fraction(colour.b));
      // Where the file has none, assimp makes one up, which has this name, or none and is white.
      const bool made_up = name == AI_DEFAULT_MATERIAL_NAME || (name.empty() && material.colour == glm::dvec3(1.0));
      own_material_ = own_material_ || !made_up;
    }
    if (name.empty()) name = fmt::format("material{}", index);
    material.name = std::filesystem::path(path_).filename().string() + ':' + name;
    result_.materials.push_back(material);
    return entry->second;
  }

  static double fraction(float value) {
    return std::isfinite(value) ? std::clamp(static_cast<double>(value), 0.0, 1.0) : 0.0;
  }

  const std::string& path_;
  const aiScene& scene_;
  bool facet_normals_;
  bool own_material_ = false;
  std::map<unsigned, std::uint16_t> materials_;
  ImportedMesh result_;
};

bool is_stl(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  return extension == ".stl";
}

}  // namespace

ImportedMesh import_mesh(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) refuse(path, "does not exist");
  if (!std::filesystem::is_regular_file(path, ignored)) refuse(path, "is not a file");
  if (!std::ifstream(path, std::ios::binary)) refuse(path, "cannot be read");
  const std::string bytes = read_bytes(path);
  if (bytes.empty()) refuse(path, "is empty");

  std::set<std::string> opened;
  Assimp::Importer importer;
  importer.SetIOHandler(new WatchedFiles(opened));  // the importer deletes it
  const DroppedFaces dropped;
  // Polygons are triangulated here: assimp's own step aborts the program on some damaged files.
  const aiScene* scene = importer.ReadFile(path, aiProcess_ValidateDataStructure);
  if (scene == nullptr) refuse(path, fmt::format("is not a mesh that can be read: {}", importer.GetErrorString()));
  if (dropped.any()) refuse(path, "a face names a vertex that does not exist");
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0 || scene->mRootNode == nullptr || scene->mNumMeshes == 0)
    refuse(path, "has no triangle");
  ImportedMesh result = Reading(path, *scene, is_stl(path)).run();
  result.digest = digest_of(path, bytes, std::move(opened));
  return result;
}

}  // namespace rastertlm::scene
