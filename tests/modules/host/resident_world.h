// A small world for tests of the host: meshes of random triangles, and where they stand at each frame.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "modules/host/computation.h"
#include "modules/host/resident_scene.h"

namespace rastertlm::host {

inline constexpr std::size_t kColumns = 64;
inline constexpr std::size_t kLines = 48;
inline constexpr int kWordBits = 24;
inline constexpr double kNear = 5.0;
inline constexpr double kFar = 20.0;

// Sees, ten units away, 5 to the left and right and 3.75 up and down; z in 0..w from near to far.
inline glm::dmat4 perspective() {
  glm::dmat4 matrix(0.0);
  matrix[0][0] = 2.0;
  matrix[1][1] = 2.0 * static_cast<double>(kColumns) / static_cast<double>(kLines);
  matrix[2][2] = kFar / (kNear - kFar);
  matrix[3][2] = kNear * kFar / (kNear - kFar);
  matrix[2][3] = -1.0;
  return matrix;
}

struct World {
  std::deque<geometry::Mesh> meshes;
  ResidentScene resident;
  glm::dmat4 eye_to_clip{1.0};
  std::vector<std::vector<glm::dvec3>> places;  // by frame, by object

  explicit World(const glm::dmat4& projection = perspective()) : eye_to_clip(projection) {
    resident.pose = [this](std::int64_t frame) { return pose(frame); };
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  geometry::Mesh& add(bool two_sided, bool moves) {
    meshes.emplace_back();
    resident.objects.push_back({&meshes.back(), two_sided, moves});
    return meshes.back();
  }

  geometry::Pose pose(std::int64_t frame) const {
    geometry::Pose pose;
    pose.eye_to_clip = eye_to_clip;
    for (const glm::dvec3& place : places.at(static_cast<std::size_t>(frame))) {
      glm::dmat4 matrix(1.0);
      for (int i = 0; i < 3; ++i) matrix[3][i] = place[i];
      pose.object_to_eye.push_back(matrix);
      pose.normal_to_eye.emplace_back(1.0);
    }
    pose.lights.resize(1);
    return pose;
  }

  std::size_t triangles() const {
    std::size_t count = 0;
    for (const geometry::Mesh& mesh : meshes) count += mesh.triangles.size();
    return count;
  }
};

inline void add_triangle(geometry::Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         std::uint16_t material = 0) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.normals.insert(mesh.normals.end(), 3, glm::dvec3(0, 0, 1));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.material.push_back(material);
}

// Corners within `radius` of the mesh's middle, normals of unit length, facing either way.
inline void add_random_triangles(geometry::Mesh& mesh, std::size_t count, double radius, std::mt19937& random) {
  const auto real = [&] { return static_cast<double>(random()) / 2147483648.0 - 1.0; };
  for (std::size_t i = 0; i < count; ++i) {
    std::array<glm::dvec3, 3> corners{};
    for (glm::dvec3& corner : corners) corner = radius / std::sqrt(3.0) * glm::dvec3(real(), real(), real());
    add_triangle(mesh, corners[0], corners[1], corners[2], static_cast<std::uint16_t>(random() % 16));
    for (std::size_t k = mesh.normals.size() - 3; k < mesh.normals.size(); ++k) {
      const glm::dvec3 direction(real(), real(), 1.5 + real());
      mesh.normals[k] =
          direction / std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
    }
  }
}

inline MachineFormat format(std::uint32_t slots, set_up::EdgeForm edges = set_up::EdgeForm::snapped) {
  return {{kWordBits, kColumns, kLines, edges},
          *geometry::snap_grids(kColumns, kLines, kWordBits, -1),
          {kColumns, kLines},
          slots};
}

// A triangle of the scene as plain numbers: what the host computes with counted ones.
struct PlainTriangle {
  std::uint32_t object = 0;
  bool two_sided = false;
  std::uint32_t material = 0;
  geometry::ClipTriangle<double> corners;
};

inline std::vector<PlainTriangle> plain_triangles(const World& world, std::int64_t frame) {
  std::vector<PlainTriangle> result;
  const geometry::Pose pose = world.pose(frame);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    const geometry::Mesh& mesh = world.meshes[i];
    const glm::dmat4 matrix = pose.eye_to_clip * pose.object_to_eye[i];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      PlainTriangle triangle{
          static_cast<std::uint32_t>(result.size()), world.resident.objects[i].two_sided, mesh.material[t], {}};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.triangles[t][k];
        triangle.corners[k] = set_up::transform_vertex<double>(mesh.positions[corner], mesh.normals[corner], matrix,
                                                               pose.normal_to_eye[i]);
      }
      result.push_back(triangle);
    }
  }
  return result;
}

}  // namespace rastertlm::host
