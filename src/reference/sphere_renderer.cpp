#include "src/reference/sphere_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "src/geometry/lighting.h"
#include "src/reference/regions.h"
#include "src/reference/shine_observer.h"

namespace rastertlm::reference {
namespace {

struct Sphere {
  glm::dvec3 centre;
  double radius;
  std::uint16_t material;
  bool solid;  // cut by the near plane, it shows the cut; a mesh shows its sides from outside alone
};

struct Hit {
  std::size_t sphere = 0;
  double along = 0.0;  // of the ray from the near to the far plane
  bool cut = false;    // the ray starts inside
};

std::vector<Sphere> spheres_of(const scene::Scene& scene, const scene::Pose& pose) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    spheres.push_back({glm::dvec3(pose.object_to_eye[i][3]), object.sphere_radius,
                       object.solid ? object.solid->material : object.mesh.material.front(), object.solid.has_value()});
  }
  return spheres;
}

// From `from` on; the nearest side that the ray enters by, within 0..1, or where it starts inside a solid.
std::optional<Hit> nearest(const std::vector<Sphere>& spheres, const glm::dvec3& from, const glm::dvec3& ray) {
  std::optional<Hit> best;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const glm::dvec3 offset = from - spheres[i].centre;
    const double a = glm::dot(ray, ray);
    const double half_b = glm::dot(offset, ray);
    const double c = glm::dot(offset, offset) - spheres[i].radius * spheres[i].radius;
    const double discriminant = half_b * half_b - a * c;
    if (discriminant < 0.0) continue;
    const double along = (-half_b - std::sqrt(discriminant)) / a;
    const bool cut = spheres[i].solid && c < 0.0;
    if (cut && (!best || best->along > 0.0)) best = {i, 0.0, true};
    if (!cut && along >= 0.0 && along <= 1.0 && (!best || along < best->along)) best = {i, along, false};
  }
  return best;
}

}  // namespace

bool is_of_spheres(const scene::Scene& scene) {
  return !scene.objects.empty() && std::all_of(scene.objects.begin(), scene.objects.end(),
                                               [](const scene::Object& object) { return object.sphere_radius > 0.0; });
}

frame::ExactFrame render_spheres(const scene::Scene& scene, const scene::Pose& pose, std::size_t columns,
                                 std::size_t lines) {
  frame::ExactFrame out;
  out.resize(columns, lines);
  const std::vector<Sphere> spheres = spheres_of(scene, pose);
  const glm::dmat4 clip_to_eye = glm::inverse(pose.eye_to_clip);
  const bool viewer_at_eye = scene.camera.projection == scene::ProjectionKind::perspective;
  const geometry::LightingRules rules{
      scene.model == scene::LightingModel::phong ? geometry::Model::phong : geometry::Model::blinn, scene.specular_gate,
      scene.ambient_light};
  std::vector<geometry::LightSource> lights;
  for (const scene::Light& light : pose.lights)
    lights.push_back({light.kind == scene::LightKind::point, light.vector, light.intensity, light.intensity});
  const auto in_eye = [&](double x, double y, double z) {
    const glm::dvec4 point = clip_to_eye * glm::dvec4(x, y, z, 1.0);
    return glm::dvec3(point) / point.w;
  };
  std::vector<float> specular(out.pixels(), 0.0F);
  for (std::size_t line = 0; line < lines; ++line)
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t pixel = line * columns + column;
      const double x = (static_cast<double>(column) + 0.5) * 2 / static_cast<double>(columns) - 1;
      const double y = 1 - (static_cast<double>(line) + 0.5) * 2 / static_cast<double>(lines);
      const glm::dvec3 from = in_eye(x, y, 0.0);
      const glm::dvec3 ray = in_eye(x, y, 1.0) - from;
      glm::dvec3 levels = scene.background;
      if (const auto hit = nearest(spheres, from, ray)) {
        const Sphere& sphere = spheres[hit->sphere];
        const glm::dvec3 point = from + hit->along * ray;
        const scene::Material& m = scene.materials[sphere.material];
        const geometry::Reflectance surface{m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular),
                                            m.exponent};
        const glm::dvec3 normal = hit->cut ? glm::dvec3(0, 0, 1) : (point - sphere.centre) / sphere.radius;
        const glm::dvec3 viewer = viewer_at_eye ? geometry::normalised<double>(-point) : glm::dvec3(0, 0, 1);
        glm::dvec3 shine(0.0);
        levels = glm::clamp(
            255.0 * geometry::illumination<double>(surface, lights, rules, normal, viewer, point, ShineObserver{shine}),
            0.0, 255.0);
        specular[pixel] = largest_level(shine);
        const glm::dvec4 clip = pose.eye_to_clip * glm::dvec4(point, 1.0);
        out.depth[pixel] = clip.z / clip.w;
        out.object[pixel] = static_cast<std::uint32_t>(hit->sphere + 1);
        out.coverage[pixel] = 1;
      }
      for (int c = 0; c < 3; ++c) out.rgb.set(3 * pixel + static_cast<std::size_t>(c), levels[c]);
    }
  // Spheres that do not show the same at two pixels are others.
  mark_regions(out, specular, [](std::size_t, std::size_t) { return true; });
  return out;
}

}  // namespace rastertlm::reference
