// A scene file as it is written: what each key is, its default and its range. `scene.h` is what it becomes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/geometry/pose.h"
#include "src/parameter/table.h"

namespace rastertlm::scene {

using parameter::IndexTriple;
using parameter::Triple;

enum class ProjectionKind { perspective, orthographic };
using geometry::LightKind;
enum class ObjectKind {
  teapot,
  uv_sphere,
  mesh,
  triangles,
  // Solids from here on.
  sphere,
  ellipsoid,
  cylinder,
  cone,
  paraboloid,
  hyperboloid,
  quadric
};
enum class AnimationKind { spin, orbit, keys };
enum class LightingModel { blinn, phong };

// World units: coordinates stay within it, so that their differences keep what a pixel needs.
inline constexpr double kFarthest = 1e9;

// One key frame: where the thing is at that frame. Between keys, positions and angles go linearly.
struct KeyDescription {
  double frame = 0.0;
  Triple translate{0, 0, 0};
  Triple rotate_deg{0, 0, 0};
  void declare(parameter::Table& table);
};

struct AnimationDescription {
  AnimationKind kind = AnimationKind::spin;
  Triple axis{0, 0, 1};  // spin, orbit: through `centre`
  Triple centre{0, 0, 0};
  double deg_per_frame = 1.0;  // spin, orbit
  std::vector<KeyDescription> keys;
  void declare(parameter::Table& table);
};

struct CameraDescription {
  ProjectionKind projection = ProjectionKind::perspective;
  Triple eye{0, -14, 5};
  Triple target{0, 0, 1.5};
  Triple up{0, 0, 1};
  double vertical_fov_deg = 30.0;
  double height = 10.0;  // orthographic: of the view volume, world units
  double near = 1.0;
  double far = 100.0;
  std::vector<AnimationDescription> animation;
  void declare(parameter::Table& table);  // keys "camera.eye" ...
};

struct LightDescription {
  LightKind kind = LightKind::directional;
  Triple towards{0.5, -0.6, 1.0};  // directional: from the surface to the light, world space, any length
  Triple position{0, 0, 0};        // point
  Triple intensity{1, 1, 1};
  void declare(parameter::Table& table);
};

struct MaterialDescription {
  std::string name;
  Triple colour{0.8, 0.8, 0.8};
  double ambient = 0.1;
  double diffuse = 0.5;
  double specular = 0.4;
  std::int64_t exponent = 20;
  void declare(parameter::Table& table);
};

// Cuts a solid: what remains is where normal . x <= distance.
struct PlaneDescription {
  Triple normal{0, 0, 1};  // the object's own space, any length
  double distance = 0.0;   // in lengths of the normal
  void declare(parameter::Table& table);
};

struct ObjectDescription {
  ObjectKind kind = ObjectKind::teapot;
  std::string material;
  Triple translate{0, 0, 0};
  Triple rotate_deg{0, 0, 0};  // about x, then y, then z
  Triple scale{1, 1, 1};
  bool two_sided = false;
  std::int64_t segments = 4;  // teapot: quads a patch and direction
  std::int64_t patches = 28;  // teapot: 28 or 32
  double radius = 1.0;        // uv_sphere, and round solids
  std::int64_t slices = 12;
  std::int64_t stacks = 8;
  Triple radii{1, 1, 1};     // ellipsoid
  double height = 2.0;       // cylinder, cone, paraboloid, hyperboloid
  std::int64_t sheets = 1;   // hyperboloid: 1 or 2
  double waist = 0.5;        // hyperboloid
  bool capped = true;        // cylinder, cone, paraboloid, hyperboloid
  Triple squares{1, 1, 1};   // quadric: of x^2, y^2, z^2
  Triple products{0, 0, 0};  // of xy, yz, zx
  Triple linear{0, 0, 0};    // of x, y, z
  double constant = -1.0;
  std::string file;               // mesh
  std::vector<Triple> positions;  // triangles: three a triangle, or indexed by `indices`
  std::vector<Triple> normals;    // one a position, or none
  std::vector<IndexTriple> indices;
  std::vector<AnimationDescription> animation;
  std::vector<PlaneDescription> planes;  // solids
  void declare(parameter::Table& table);

 private:
  void declare_solid(parameter::Table& table);
};

struct SceneDescription {
  std::int64_t schema = 1;
  Triple background{0, 0, 0};                  // levels 0..255
  Triple ambient_light{1, 1, 1};               // Ia, a channel
  LightingModel model = LightingModel::blinn;  // lighting.model
  bool specular_gate = false;                  // lighting.specular_gate
  CameraDescription camera;
  std::vector<LightDescription> lights;
  std::vector<MaterialDescription> materials;
  std::vector<ObjectDescription> objects;
  void declare(parameter::Table& table);
};

}  // namespace rastertlm::scene
