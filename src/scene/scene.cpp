#include "src/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>

#include "src/base/digest.h"
#include "src/scene/check.h"
#include "src/scene/import.h"
#include "src/scene/inline_triangles.h"
#include "src/scene/primitives.h"
#include "src/scene/solids.h"
#include "src/scene/transform.h"

namespace rastertlm::scene {
namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

class Builder {
 public:
  Builder(const SceneDescription& description, const std::string& file, const std::string& directory)
      : description_(description), directory_(directory), problems_(file) {}

  Scene run() {
    check(description_, problems_);
    // Nothing is tessellated from numbers that may be out of range, but mesh files are looked at, so that their faults
    // are reported too.
    const bool sound = problems_.count() == 0;
    copy_settings();
    for (std::size_t i = 0; i < description_.objects.size(); ++i)
      if (sound || description_.objects[i].kind == ObjectKind::mesh ||
          description_.objects[i].kind == ObjectKind::triangles)
        add_object(description_.objects[i], fmt::format("object[{}]", i));
    problems_.throw_if_any();
    scene_.digest = sha256_hex(canonical_text(description_, {"file"}) + mesh_digests_);
    return std::move(scene_);
  }

 private:
  void copy_settings() {
    scene_.background = vector(description_.background);
    scene_.ambient_light = vector(description_.ambient_light);
    scene_.model = description_.model;
    scene_.specular_gate = description_.specular_gate;
    scene_.camera = description_.camera;
    for (const LightDescription& light : description_.lights) {
      const bool directional = light.kind == LightKind::directional;
      scene_.lights.push_back({light.kind, directional ? glm::normalize(vector(light.towards)) : vector(light.position),
                               vector(light.intensity)});
    }
    for (const MaterialDescription& m : description_.materials)
      scene_.materials.push_back(
          {m.name, vector(m.colour), m.ambient, m.diffuse, m.specular, static_cast<int>(m.exponent)});
  }

  void add_object(const ObjectDescription& description, const std::string& path) {
    Object object;
    object.two_sided = description.two_sided;
    object.animation = description.animation;
    const glm::dvec3 scale = vector(description.scale);
    object.placement =
        translation(vector(description.translate)) * rotation_xyz_deg(vector(description.rotate_deg)) * scaling(scale);
    const bool round = std::fabs(scale.x) == std::fabs(scale.y) && std::fabs(scale.y) == std::fabs(scale.z);
    const bool whole_sphere = description.kind == ObjectKind::sphere && description.planes.empty();
    if ((description.kind == ObjectKind::uv_sphere || whole_sphere) && round)
      object.sphere_radius = description.radius * std::fabs(scale.x);
    if (is_solid(description.kind)) {
      object.solid = make_solid(description);
      object.solid->material = named_material(description.material);
      scene_.objects.push_back(std::move(object));
      return;
    }
    object.mesh = make_mesh(description, path);
    Mesh& mesh = object.mesh;
    if (mesh.triangles.empty()) return;
    if (mesh.degenerate == mesh.triangles.size() && !problems_.mentions(path))
      problems_.add(path, fmt::format("none of its {} triangles has an area", mesh.triangles.size()));
    if (scale.x * scale.y * scale.z < 0.0)  // mirrored: outside must be counter-clockwise again once it is placed
      for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    scene_.objects.push_back(std::move(object));
  }

  Mesh make_mesh(const ObjectDescription& description, const std::string& path) {
    Mesh mesh;
    switch (description.kind) {
      case ObjectKind::teapot:
        mesh = teapot(static_cast<std::size_t>(description.segments), static_cast<std::size_t>(description.patches));
        break;
      case ObjectKind::uv_sphere:
        mesh = uv_sphere(description.radius, static_cast<std::size_t>(description.slices),
                         static_cast<std::size_t>(description.stacks));
        break;
      case ObjectKind::triangles:
        mesh = inline_triangles(description, path, problems_);
        break;
      case ObjectKind::mesh:
        return import(description, path);
      default:
        return {};  // a solid
    }
    mesh.material.assign(mesh.triangles.size(), named_material(description.material));
    return mesh;
  }

  Mesh import(const ObjectDescription& description, const std::string& path) {
    if (description.file.empty()) return {};
    ImportedMesh imported;
    try {
      imported = import_mesh((std::filesystem::path(directory_) / description.file).string());
    } catch (const InputError& error) {
      for (const Diagnostic& d : error.diagnostics())
        problems_.add(path + ".file", fmt::format("'{}' {}", description.file, d.message));
      return {};
    }
    mesh_digests_ += imported.digest + '\n';
    Mesh mesh = std::move(imported.mesh);
    if (!description.material.empty() || imported.materials.empty()) {
      if (description.material.empty() && description_.materials.empty())
        problems_.add(path + ".material", fmt::format("neither the scene nor '{}' has a material", description.file));
      mesh.material.assign(mesh.triangles.size(), named_material(description.material));
      return mesh;
    }
    std::vector<std::uint16_t> numbers;
    for (const Material& material : imported.materials) numbers.push_back(file_material(material, path));
    for (std::uint16_t& number : mesh.material) number = numbers[number];
    return mesh;
  }

  // "" is the first; a name that is not known has been reported.
  std::uint16_t named_material(const std::string& name) const {
    for (std::size_t i = 0; i < description_.materials.size(); ++i)
      if (description_.materials[i].name == name) return static_cast<std::uint16_t>(i);
    return 0;
  }

  // Two objects of one file share its materials. A material of the scene file with that name is used instead of the
  // file's.
  std::uint16_t file_material(const Material& material, const std::string& path) {
    const auto known = std::find_if(scene_.materials.begin(), scene_.materials.end(), [&](const Material& m) {
      const bool of_scene = &m < scene_.materials.data() + description_.materials.size();
      return m.name == material.name && (of_scene || m.colour == material.colour);
    });
    if (known != scene_.materials.end()) return static_cast<std::uint16_t>(known - scene_.materials.begin());
    if (scene_.materials.size() > std::numeric_limits<std::uint16_t>::max()) {
      problems_.add(path + ".file", "the scene has more than 65536 materials");
      return 0;
    }
    scene_.materials.push_back(material);
    return static_cast<std::uint16_t>(scene_.materials.size() - 1);
  }

  const SceneDescription& description_;
  std::string directory_;
  Problems problems_;
  Scene scene_;
  std::string mesh_digests_;
};

}  // namespace

std::size_t Scene::triangle_count() const {
  std::size_t count = 0;
  for (const Object& object : objects) count += object.mesh.triangles.size();
  return count;
}

std::size_t Scene::solid_count() const {
  return static_cast<std::size_t>(
      std::count_if(objects.begin(), objects.end(), [](const Object& object) { return object.solid.has_value(); }));
}

std::size_t Scene::object_count() const { return triangle_count() + solid_count(); }

Scene build_scene(const SceneDescription& description, const std::string& file, const std::string& directory) {
  return Builder(description, file, directory).run();
}

}  // namespace rastertlm::scene
