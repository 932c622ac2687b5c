#include "src/scene/import.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string_view>

#include "src/base/digest.h"
#include "src/base/errors.h"
#include "src/scene/mesh_builder.h"
#include "src/scene/mesh_file.h"
#include "src/scene/transform.h"
#include "src/scene/triangulate.h"

namespace rastertlm::scene {
namespace {

constexpr std::size_t kMostVertices = std::size_t{1} << 24;  // some gigabytes, and more triangles than any machine has

constexpr std::size_t kMostNamedCorners = std::size_t{1} << 23;  // of faces, each time that a node names them

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw InputError({path, 0, "", message});
}

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string digest_of(const std::string& path, const std::string& bytes, const std::vector<std::string>& opened) {
  std::string text = sha256_hex(bytes);
  for (const std::string& other : opened)
    if (other != path) text += '\n' + sha256_hex(read_bytes(other));
  return sha256_hex(text);
}

glm::dvec3 vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// One file on its way to a mesh.
class Reading {
 public:
  Reading(const std::string& path, const MeshFile& file, bool facet_normals)
      : path_(path), file_(file), facet_normals_(facet_normals) {}

  ImportedMesh run() {
    check_size();
    std::vector<glm::dmat4> to_file;
    for (const MeshFile::Node& node : file_.nodes) {
      if (!to_file.empty() && node.parent >= to_file.size()) refuse(path_, "a node comes before the one it is part of");
      to_file.push_back(to_file.empty() ? node.to_parent : to_file[node.parent] * node.to_parent);
      for (const std::uint32_t part : node.parts) {
        if (part >= file_.parts.size()) refuse(path_, "a node names a mesh that does not exist");
        add_part(file_.parts[part], to_file.back());
      }
    }
    if (result_.mesh.triangles.empty()) refuse(path_, "has no triangle");
    fill_normals();
    join_vertices(result_.mesh);
    result_.mesh.degenerate = count_degenerate(result_.mesh);
    if (!own_material_) result_.materials.clear();
    return std::move(result_);
  }

 private:
  // Nodes may name a mesh again and again: a small file then holds more than any memory.
  void check_size() const {
    std::size_t own = 0, named = 0;
    for (const MeshFile::Part& part : file_.parts) own += part.corners.size();
    for (const MeshFile::Node& node : file_.nodes)
      for (const std::uint32_t part : node.parts)
        if (part < file_.parts.size()) named += file_.parts[part].corners.size();
    if (named > std::max(own, kMostNamedCorners))
      refuse(path_, fmt::format("its nodes have meshes of {} corners in {} places: at most {} are read", own, named,
                                std::max(own, kMostNamedCorners)));
  }

  void add_part(const MeshFile::Part& part, const glm::dmat4& to_file) {
    Mesh& out = result_.mesh;
    const std::size_t base = out.positions.size();
    if (part.positions.size() > kMostVertices - base)
      refuse(path_, fmt::format("has more than {} vertices", kMostVertices));
    const glm::dmat3 linear(to_file);
    const glm::dmat3 for_normals = inverse_transpose(linear);
    const bool mirrored = glm::dot(linear[0], glm::cross(linear[1], linear[2])) < 0.0;
    const bool has_normals = part.normals.size() == part.positions.size() && !facet_normals_;
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
      const glm::dvec3 position(to_file * glm::dvec4(vector_of(part.positions[i]), 1.0));
      if (!is_finite(position)) refuse(path_, fmt::format("vertex {} is not finite", base + i));
      out.positions.push_back(position);
      out.normals.push_back(has_normals ? for_normals * vector_of(part.normals[i]) : glm::dvec3(0.0));
      if (!is_finite(out.normals.back())) refuse(path_, fmt::format("the normal of vertex {} is not finite", base + i));
    }
    const std::uint16_t material = material_of(part.material);
    std::size_t first = 0;
    for (const std::uint32_t count : part.face_corners) {
      if (count > part.corners.size() - first) refuse(path_, "a face has more corners than there are");
      add_face(part, {part.corners.data() + first, count}, base, mirrored, material);
      first += count;
    }
  }

  void add_face(const MeshFile::Part& part, std::span<const std::uint32_t> face, std::size_t base, bool mirrored,
                std::uint16_t material) {
    for (const std::uint32_t corner : face)
      if (corner >= part.positions.size())
        refuse(path_, fmt::format("a face names vertex {}: there are {}", corner, part.positions.size()));
    if (face.empty()) refuse(path_, "a face has no corner: the file is damaged or cut short");
    if (face.size() < 3) {
      ++result_.mesh.left_out;
      return;
    }
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t corner : face) corners.push_back(result_.mesh.positions[base + corner]);
    const auto at = [&](std::uint32_t corner) { return static_cast<std::uint32_t>(base + face[corner]); };
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
    if (index < file_.materials.size()) {
      const MeshFile::Colour& source = file_.materials[index];
      name = source.name;
      if (source.colour) {
        const auto& [red, green, blue] = *source.colour;
        material.colour = glm::dvec3(fraction(red), fraction(green), fraction(blue));
      }
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
  const MeshFile& file_;
  bool facet_normals_;
  bool own_material_ = false;
  std::map<unsigned, std::uint16_t> materials_;
  ImportedMesh result_;
};

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  return text;
}

bool is_stl(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return in_small_letters(extension) == ".stl";
}

// Where a PLY file's header does not end in a line of its own, assimp looks for the end for ever.
bool is_ply_without_end(const std::string& bytes) {
  constexpr std::string_view kEnd = "end_header";
  if (in_small_letters(bytes.substr(0, 3)) != "ply") return false;
  for (std::size_t at = bytes.find(kEnd); at != std::string::npos; at = bytes.find(kEnd, at + 1)) {
    const std::size_t after = at + kEnd.size();
    const bool alone = bytes[at - 1] == '\n' || bytes[at - 1] == '\r';
    if (alone && after < bytes.size() && (bytes[after] == '\n' || bytes[after] == '\r')) return false;
  }
  return true;
}

}  // namespace

ImportedMesh import_mesh(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) refuse(path, "does not exist");
  if (!std::filesystem::is_regular_file(path, ignored)) refuse(path, "is not a file");
  if (!std::ifstream(path, std::ios::binary)) refuse(path, "cannot be read");
  const std::string bytes = read_bytes(path);
  if (bytes.empty()) refuse(path, "is empty");
  if (is_ply_without_end(bytes)) refuse(path, "is not a mesh that can be read: its header does not end");

  const MeshFile file = read_mesh_file(path, bytes.size());
  ImportedMesh result = Reading(path, file, is_stl(path)).run();
  result.digest = digest_of(path, bytes, file.opened);
  return result;
}

}  // namespace rastertlm::scene
