// A scene, read and checked: meshes in memory, materials and lights resolved, and where everything stands at a given
// frame. World and eye space are right-handed; the eye looks along -z with y up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

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

struct Light {
  LightKind kind = LightKind::directional;
  glm::dvec3 vector{0, 0, 1};  // directional: unit, from the surface to the light; point: position. World space
  glm::dvec3 intensity{1.0};
};

// Triangles that share vertices. Counter-clockwise seen from outside.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  // one a position, unit length, outwards
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> material;  // one a triangle, an index of Scene::materials
  std::size_t degenerate = 0;  // of `triangles`, those whose corners coincide or are in line (they stay in the list)
  std::size_t left_out = 0;    // points and lines of a mesh file, which are not drawn
};

struct Object {
  Mesh mesh;                  // its own space
  glm::dmat4 placement{1.0};  // to world space, before animation
  bool two_sided = false;
  std::vector<AnimationDescription> animation;
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
};

// Everything that can move, at one frame. Angles are computed from the frame number, never summed.
struct Pose {
  glm::dmat4 world_to_eye{1.0};
  glm::dmat4 eye_to_clip{1.0};            // z in 0..w from near to far (GLM's _ZO)
  std::vector<glm::dmat4> object_to_eye;  // one an object
  std::vector<glm::dmat3> normal_to_eye;  // one an object: inverse transpose, scaled by one factor an object so that no
                                          // normal of it gets longer than 1
  std::vector<Light> lights;              // in eye space
};

// `columns` / `lines` is the aspect ratio of the view volume.
Pose pose(const Scene& scene, std::int64_t frame, std::size_t columns, std::size_t lines);

// Whether anything differs between frames: the camera, each object.
bool camera_moves(const Scene& scene);
bool object_moves(const Scene& scene, std::size_t object);

// Makes the scene of a description: primitives tessellated, mesh files imported (paths relative to `directory`),
// materials found by name. Throws InputError with everything that is wrong; `file` names the scene file in the
// diagnostics.
Scene build_scene(const SceneDescription& description, const std::string& file, const std::string& directory);

}  // namespace rastertlm::scene
