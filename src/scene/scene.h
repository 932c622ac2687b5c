// A scene, read and checked: meshes in memory, materials and lights resolved, and where everything stands at a given
// frame. World and eye space are right-handed; the eye looks along -z with y up.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "src/geometry/mesh.h"
#include "src/geometry/pose.h"
#include "src/geometry/solid.h"
#include "src/scene/description.h"

namespace rastertlm::scene {

struct Material {
  std::string name;
  glm::dvec3 colour{0.8};
  double ambient = 0.1;   // Ka
  double diffuse = 0.5;   // Kd
  double specular = 0.4;  // Ks
  int exponent = 20;      // E
};

using geometry::Light;  // of a scene: in world space
using geometry::Mesh;
using geometry::Pose;
using geometry::Solid;

struct Object {
  Mesh mesh;                   // its own space; empty where it is a solid
  std::optional<Solid> solid;  // likewise its own space
  glm::dmat4 placement{1.0};   // to world space, before animation
  bool two_sided = false;
  std::vector<AnimationDescription> animation;
  double sphere_radius = 0.0;  // placed: it is, or its mesh stands for, a sphere about its origin; 0: it is none
};

struct Scene {
  glm::dvec3 background{0.0};     // levels
  glm::dvec3 ambient_light{1.0};  // Ia
  LightingModel model = LightingModel::blinn;
  bool specular_gate = false;
  CameraDescription camera;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::string digest;  // SHA-256 of the description and of every mesh file's bytes

  std::size_t triangle_count() const;
  std::size_t solid_count() const;
  // Of what is drawn: every triangle and every solid. They are numbered in this order of the objects, from 1 in frames.
  std::size_t object_count() const;
};

// Angles are computed from the frame number, never summed. `columns` / `lines` is the aspect ratio of the view volume.
Pose pose(const Scene& scene, std::int64_t frame, std::size_t columns, std::size_t lines);

// Whether anything differs between frames: the camera, each object.
bool camera_moves(const Scene& scene);
bool object_moves(const Scene& scene, std::size_t object);

// Makes the scene of a description: primitives tessellated, mesh files imported (paths relative to `directory`),
// materials found by name. Throws InputError with everything that is wrong; `file` names the scene file in the
// diagnostics.
Scene build_scene(const SceneDescription& description, const std::string& file, const std::string& directory);

}  // namespace rastertlm::scene
