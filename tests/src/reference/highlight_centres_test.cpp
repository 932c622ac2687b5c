// Does the search of every triangle find the places that geometry gives?
#include "src/reference/highlight_centres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "src/scene/primitives.h"

namespace rastertlm::reference {
namespace {

// Far light and viewer: one place of a sphere shines, in the triangle whose normals hold the halfway vector.
TEST(HighlightCentres, AreOneASphereSeenFromFar) {
  const geometry::Mesh mesh = scene::uv_sphere(1.0, 17, 12);
  std::mt19937_64 random(3);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  for (int round = 0; round < 20; ++round) {
    const glm::dmat4 turned =
        glm::rotate(glm::dmat4(1.0), 3 * number(), glm::normalize(glm::dvec3(number(), 0.7, number())));
    const glm::dvec3 light = glm::normalize(glm::dvec3(number(), number(), 0.8));
    const std::vector<geometry::Light> lights{{geometry::LightKind::directional, light, glm::dvec3(1.0)}};
    const auto centres = highlight_centres(mesh, turned, glm::dmat3(turned), lights, false);
    ASSERT_EQ(centres.size(), 1U);
    const glm::dvec3 halfway = glm::normalize(light + glm::dvec3(0, 0, 1));
    const auto& corners = mesh.triangles[centres[0].triangle];
    const glm::dmat3 normals(glm::dmat3(turned) * mesh.normals[corners[0]],
                             glm::dmat3(turned) * mesh.normals[corners[1]],
                             glm::dmat3(turned) * mesh.normals[corners[2]]);
    const glm::dvec3 weights = glm::inverse(normals) * halfway;
    EXPECT_GE(std::min({weights.x, weights.y, weights.z}), -1e-9);
  }
}

// A mirror: the light at (x, y, z) is seen by the eye at the origin in a plane z = -d at the point where the angles are
// equal, (x, y) d / (2 d + z).
TEST(HighlightCentres, OfAPlaneAreWhereAMirrorShows) {
  geometry::Mesh mesh;
  mesh.positions = {{-10, -10, -4}, {10, -10, -4}, {10, 10, -4}, {-10, 10, -4}};
  mesh.normals.assign(4, glm::dvec3(0, 0, 1));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = {0, 0};
  for (const double x : {-6.0, -2.0, 3.0, 8.0})
    for (const double y : {-7.0, 1.0, 5.0}) {
      const std::vector<geometry::Light> lights{{geometry::LightKind::point, {x, y, 2.0}, glm::dvec3(1.0)}};
      const auto centres = highlight_centres(mesh, glm::dmat4(1.0), glm::dmat3(1.0), lights, true);
      ASSERT_EQ(centres.size(), 1U) << x << ' ' << y;
      EXPECT_EQ(centres[0].triangle, x > y ? 0U : 1U);
    }
  // From behind nothing shines.
  const std::vector<geometry::Light> behind{{geometry::LightKind::point, {1.0, 2.0, -9.0}, glm::dvec3(1.0)}};
  EXPECT_TRUE(highlight_centres(mesh, glm::dmat4(1.0), glm::dmat3(1.0), behind, true).empty());
}

}  // namespace
}  // namespace rastertlm::reference
