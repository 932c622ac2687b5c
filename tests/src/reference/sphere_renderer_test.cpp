// Is the exact sphere what a very fine mesh of it comes to, and is the error of a coarse mesh the known one?
#include "src/reference/sphere_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "src/reference/renderer.h"
#include "src/scene/primitives.h"

namespace rastertlm::reference {
namespace {

constexpr std::size_t kSide = 200;

scene::Scene sphere(std::size_t slices, std::size_t stacks, scene::ProjectionKind projection, double exponent) {
  scene::Scene scene;
  scene.model = scene::LightingModel::phong;
  scene.specular_gate = true;
  scene.camera.projection = projection;
  scene.camera.eye = {0, 0, 10};
  scene.camera.target = {0, 0, 0};
  scene.camera.up = {0, 1, 0};
  scene.camera.height = 4.3;
  scene.camera.vertical_fov_deg = 26;
  scene.camera.near = 5;
  scene.camera.far = 15;
  scene.materials.push_back({"white", glm::dvec3(1.0), 0.1, 0.5, 0.4, static_cast<int>(exponent)});
  geometry::Light light;
  light.vector = glm::normalize(glm::dvec3(0.5, 0.6, 1));
  scene.lights.push_back(light);
  light.kind = geometry::LightKind::point;
  light.vector = {3, -2, 4};
  light.intensity = glm::dvec3(0.3);
  scene.lights.push_back(light);
  scene::Object object;
  object.mesh = scene::uv_sphere(2.0, slices, stacks);
  object.mesh.material.assign(object.mesh.triangles.size(), 0);
  object.sphere_radius = 2.0;
  object.placement = glm::translate(glm::dmat4(1.0), {0.1, -0.05, 0.2});
  scene.objects.push_back(object);
  return scene;
}

// Largest difference of a level where both are covered, and how many pixels one alone covers.
std::pair<double, int> apart(const scene::Scene& scene, double depth_tolerance) {
  const scene::Pose pose = scene::pose(scene, 0, kSide, kSide);
  RenderOptions options;
  options.kind = Reference::true_model;
  options.columns = options.lines = kSide;
  options.grids = {{4, kSide, kSide}, {4, kSide, kSide}};
  const frame::ExactFrame mesh = render(scene, pose, options);
  const frame::ExactFrame exact = render_spheres(scene, pose, kSide, kSide);
  std::pair<double, int> result{0.0, 0};
  int both = 0;
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    if ((mesh.object[pixel] != 0) != (exact.object[pixel] != 0)) ++result.second;
    if (mesh.object[pixel] == 0 || exact.object[pixel] == 0) continue;
    ++both;
    for (std::size_t c = 0; c < 3; ++c)
      result.first = std::max(result.first, std::fabs(mesh.rgb[3 * pixel + c] - exact.rgb[3 * pixel + c]));
    EXPECT_NEAR(mesh.depth[pixel], exact.depth[pixel], depth_tolerance);
  }
  EXPECT_GT(both, 10'000);
  return result;
}

TEST(SphereRenderer, IsTheLimitOfFineMeshes) {
  for (const auto projection : {scene::ProjectionKind::orthographic, scene::ProjectionKind::perspective}) {
    const auto coarse = apart(sphere(24, 16, projection, 20), 0.1);
    const auto fine = apart(sphere(400, 300, projection, 20), 0.002);
    EXPECT_LT(fine.first, 1.0);
    EXPECT_LT(fine.second, 60);
    EXPECT_GT(coarse.first, 5 * fine.first);
    EXPECT_GT(coarse.second, fine.second);
  }
}

TEST(SphereRenderer, KnowsScenesOfSpheres) {
  scene::Scene scene = sphere(12, 8, scene::ProjectionKind::orthographic, 5);
  EXPECT_TRUE(is_of_spheres(scene));
  scene.objects.push_back(scene.objects.front());
  scene.objects.back().sphere_radius = 0.0;
  EXPECT_FALSE(is_of_spheres(scene));
  EXPECT_FALSE(is_of_spheres(scene::Scene{}));
}

}  // namespace
}  // namespace rastertlm::reference
