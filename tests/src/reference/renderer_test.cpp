// Are the exact renderers exact? By hand, and against renderers that do everything in another way, a pixel and a
// triangle at a time.
#include "src/reference/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/base/errors.h"
#include "src/geometry/lighting.h"
#include "tests/src/reference/exact_cover.h"
#include "tests/src/reference/pictures.h"

namespace rastertlm::reference {
namespace {

using testing_support::add_flat_triangle;
using testing_support::add_triangle;
using testing_support::Found;
using testing_support::kToEye;
using testing_support::Picture;
using testing_support::Random;

constexpr std::array kAll{Reference::ideal, Reference::snapped, Reference::true_model};

glm::dvec3 rgb_at(const frame::ExactFrame& frame, std::size_t x, std::size_t y) {
  const double* p = &frame.rgb[3 * (y * frame.columns + x)];
  return {p[0], p[1], p[2]};
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << what << ", channel " << i;
}

scene::Light directional(const glm::dvec3& towards, const glm::dvec3& intensity = glm::dvec3(1.0)) {
  return {scene::LightKind::directional, glm::normalize(towards), intensity};
}

TEST(Renderer, Names) {
  EXPECT_EQ(to_string(Reference::ideal), "ideal");
  EXPECT_EQ(to_string(Reference::snapped), "snapped");
  EXPECT_EQ(to_string(Reference::true_model), "true");
}

// A square of samples 2..5 x 1..3 at depth 0.3; light and viewer along its normal: 255 (.1 + .5 + .4) is full scale; in
// blue the light is half as bright: 255 (.1 + .25 + .2).
TEST(Renderer, ASquareByHand) {
  Picture p(8, 6);
  p.look_at_pixels();
  p.scene.background = {1, 2, 3};
  p.add_light(directional(kToEye, {1, 1, 0.5}));
  scene::Mesh& mesh = p.add_object();
  add_flat_triangle(mesh, {{{1.5, -3.5, -30}, {5.5, -3.5, -30}, {5.5, -0.5, -30}}});
  add_flat_triangle(mesh, {{{1.5, -3.5, -30}, {5.5, -0.5, -30}, {1.5, -0.5, -30}}});
  for (const Reference kind : kAll) {
    const frame::ExactFrame out = p.render_as(kind);
    for (std::size_t y = 0; y < 6; ++y)
      for (std::size_t x = 0; x < 8; ++x) {
        const bool inside = x >= 2 && x <= 5 && y >= 1 && y <= 3;
        const std::size_t pixel = y * 8 + x;
        EXPECT_EQ(out.coverage[pixel], inside ? 1U : 0U) << x << "," << y;
        EXPECT_EQ(out.object[pixel] != 0, inside);
        EXPECT_NEAR(out.depth[pixel], inside ? 0.3 : 1.0, 1e-14);
        expect_near(rgb_at(out, x, y), inside ? glm::dvec3{255, 255, 140.25} : glm::dvec3{1, 2, 3}, 1e-11,
                    to_string(kind));
      }
    EXPECT_EQ(out.object[1 * 8 + 2], 2U);  // the upper left triangle is the second
    EXPECT_EQ(out.object[3 * 8 + 5], 1U);
  }
}

TEST(Renderer, OneSpecularTableTakesTheMeanOfTheLight) {
  Picture p(8, 6);
  p.look_at_pixels();
  p.add_light(directional(kToEye, {1, 0.5, 0}));
  add_flat_triangle(p.add_object(), {{{0, -5, -30}, {7, -5, -30}, {0, 0, -30}}});
  p.options.specular_mean = true;
  expect_near(rgb_at(p.render_as(Reference::ideal), 1, 3),
              255.0 * glm::dvec3{0.1 + 0.5 + 0.2, 0.1 + 0.25 + 0.2, 0.1 + 0.2}, 1e-11, "mean");
}

TEST(Renderer, EqualDepthKeepsTheLowerNumberAndNearerWins) {
  Picture p(8, 8);
  p.look_at_pixels();
  for (const double z : {-40.0, -40.0, -20.0, -60.0})
    add_flat_triangle(p.add_object(), {{{0, -7, z}, {7, -7, z}, {0, 0, z}}});
  p.scene.objects[2].mesh.positions[1].x = 3;  // the near one is smaller
  for (const Reference kind : kAll) {
    const frame::ExactFrame out = p.render_as(kind);
    EXPECT_EQ(out.object[4 * 8 + 1], 3U);
    EXPECT_EQ(out.coverage[4 * 8 + 1], 4U);
    EXPECT_EQ(out.object[6 * 8 + 5], 1U);
    EXPECT_EQ(out.coverage[6 * 8 + 5], 3U);
  }
}

// Seen from behind: culled, or kept with the normal turned to the viewer.
TEST(Renderer, BackFacesAreCulledOrTurned) {
  for (const bool two_sided : {false, true}) {
    Picture p(8, 8);
    p.look_at_pixels();
    p.add_light(directional({0.6, 0, 0.8}));
    scene::Mesh& mesh = p.add_object(two_sided);
    const glm::dvec3 away{0, 0, -1};
    add_triangle(mesh, {{{0, -7, -50}, {0, 0, -50}, {7, -7, -50}}}, {away, away, away});
    for (const Reference kind : kAll) {
      const frame::ExactFrame out = p.render_as(kind);
      EXPECT_EQ(out.object[5 * 8 + 1], two_sided ? 1U : 0U);
      // N.L = .8, (N.H)^4 = .81
      expect_near(rgb_at(out, 1, 5), glm::dvec3(two_sided ? 255 * (0.1 + 0.5 * 0.8 + 0.4 * 0.81) : 0.0), 1e-11,
                  to_string(kind));
    }
  }
}

TEST(Renderer, TrianglesWithoutAreaAreNotDrawnAndKeepTheirNumber) {
  Picture p(8, 8);
  p.look_at_pixels();
  scene::Mesh& mesh = p.add_object();
  add_flat_triangle(mesh, {{{0, 0, -10}, {3, -3, -10}, {6, -6, -10}}});
  add_flat_triangle(mesh, {{{2, -2, -10}, {2, -2, -10}, {6, -6, -10}}});
  add_flat_triangle(mesh, {{{0, -7, -50}, {7, -7, -50}, {0, 0, -50}}});
  for (const Reference kind : kAll) {
    const frame::ExactFrame out = p.render_as(kind);
    EXPECT_EQ(out.object[4 * 8 + 3], 3U);
    EXPECT_EQ(*std::max_element(out.coverage.begin(), out.coverage.end()), 1U);
  }
}

TEST(Renderer, OnlyTheTrueModelHasLightsAtAPoint) {
  Picture p(8, 8);
  p.look_at_pixels();
  p.add_light({scene::LightKind::point, {0, 0, 10}, glm::dvec3(1.0)});
  EXPECT_THROW(p.render_as(Reference::ideal), InputError);
  EXPECT_THROW(p.render_as(Reference::snapped), InputError);
  EXPECT_NO_THROW(p.render_as(Reference::true_model));
}

// The point of a triangle's cone that is seen at (x, y) of normalised device coordinates: weights with w = 1, by
// Cramer's rule. No clipping and no division by a corner's w: corners may lie behind the eye.
struct Seen {
  glm::dvec3 weights;
  double z = 0.0;
  double margin() const { return std::min({weights.x, weights.y, weights.z, z, 1.0 - z}); }
};

Seen look(const glm::dmat4& projection, const scene::Mesh& mesh, std::size_t t, double x, double y) {
  glm::dmat3 m;
  glm::dvec3 z;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 clip =
        projection * glm::dvec4(mesh.positions[mesh.triangles[t][static_cast<std::size_t>(i)]], 1.0);
    m[i] = {clip.x, clip.y, clip.w};
    z[i] = clip.z;
  }
  Seen seen;
  seen.weights = glm::inverse(m) * glm::dvec3(x, y, 1.0);
  seen.z = glm::dot(seen.weights, z);
  return seen;
}

glm::dvec3 mean_of(const std::vector<glm::dvec3>& values, const std::array<std::uint32_t, 3>& corners,
                   const glm::dvec3& weights) {
  return (weights.x * values[corners[0]] + weights.y * values[corners[1]] + weights.z * values[corners[2]]) /
         (weights.x + weights.y + weights.z);
}

// Light from the surface at the pixel, by the true model.
glm::dvec3 true_levels(const Picture& p, const scene::Mesh& mesh, std::size_t t, const Seen& seen) {
  const glm::dvec3 normal = glm::normalize(mean_of(mesh.normals, mesh.triangles[t], seen.weights));
  const glm::dvec3 position = mean_of(mesh.positions, mesh.triangles[t], seen.weights);
  const bool perspective = p.scene.camera.projection == scene::ProjectionKind::perspective;
  std::vector<geometry::LightSource> lights;
  for (const scene::Light& light : p.pose.lights)
    lights.push_back({light.kind == scene::LightKind::point, light.vector, light.intensity, light.intensity});
  const scene::Material& m = p.scene.materials[0];
  const geometry::Reflectance surface{m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent};
  const geometry::LightingRules rules{
      p.scene.model == scene::LightingModel::phong ? geometry::Model::phong : geometry::Model::blinn,
      p.scene.specular_gate, p.scene.ambient_light};
  const glm::dvec3 light = geometry::illumination<double>(surface, lights, rules, normal,
                                                          perspective ? glm::normalize(-position) : kToEye, position);
  return glm::clamp(255.0 * light, 0.0, 255.0);
}

// Large triangles that cross the near and far planes, the guard band and the eye's plane.
void add_large_soup(scene::Mesh& mesh, Random& random, int triangles) {
  for (int t = 0; t < triangles; ++t) {
    std::array<glm::dvec3, 3> positions;
    std::array<glm::dvec3, 3> normals;
    for (std::size_t i = 0; i < 3; ++i) {
      positions[i] = {random.between(-15, 15), random.between(-15, 15), random.between(-60, 8)};
      normals[i] = random.normal();
    }
    add_triangle(mesh, positions, normals);
  }
}

bool faces(const scene::Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const glm::dvec3 outwards = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
  return glm::dot(outwards, mesh.positions[a]) < 0.0;
}

TEST(Renderer, ClippedTrianglesShowWhatRaysSee) {
  std::size_t compared = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    Picture p(32, 24);
    p.look_in_perspective();
    p.scene.model = seed % 2 == 0 ? scene::LightingModel::phong : scene::LightingModel::blinn;
    p.add_light({scene::LightKind::point, {3, 4, -5}, {0.9, 0.8, 0.7}});
    scene::Mesh& mesh = p.add_object();
    add_large_soup(mesh, random, 12);
    const frame::ExactFrame true_frame = p.render_as(Reference::true_model);
    p.pose.lights = {directional({0.5, 0.5, 1})};
    const frame::ExactFrame ideal = p.render_as(Reference::ideal);
    p.pose.lights = {{scene::LightKind::point, {3, 4, -5}, {0.9, 0.8, 0.7}}};
    for (std::size_t pixel = 0; pixel < true_frame.pixels(); ++pixel) {
      const double x = (static_cast<double>(pixel % 32) + 0.5) / 16 - 1;
      const double y = 1 - (static_cast<double>(pixel / 32) + 0.5) / 12;
      Found found;
      Seen nearest;
      bool clear = true;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Seen seen = look(p.pose.eye_to_clip, mesh, t, x, y);
        clear = clear && std::abs(seen.margin()) > 1e-9;
        if (seen.margin() <= 0.0 || !faces(mesh, t)) continue;
        found.add(static_cast<std::uint32_t>(t + 1), seen.z);
        if (found.nearest == t + 1) nearest = seen;
      }
      if (!clear) continue;
      ++compared;
      for (const frame::ExactFrame* out : {&true_frame, &ideal}) {
        ASSERT_EQ(out->coverage[pixel], found.coverage) << "seed " << seed << " pixel " << pixel;
        if (!found.nearest) continue;
        ASSERT_EQ(out->object[pixel], *found.nearest);
        ASSERT_NEAR(out->depth[pixel], found.depth, 1e-9);
      }
      if (found.nearest)
        expect_near(rgb_at(true_frame, pixel % 32, pixel / 32), true_levels(p, mesh, *found.nearest - 1, nearest), 1e-6,
                    "seed " + std::to_string(seed));
    }
  }
  EXPECT_GT(compared, 15000U);  // of 15,360
}

// Ideal: normals linear on the screen, also in perspective; the viewer far away in direction z.
TEST(Renderer, IdealInterpolatesNormalsOnTheScreen) {
  Picture p(40, 30);
  p.look_in_perspective();
  p.add_light(directional({0.6, 0, 0.8}));
  scene::Mesh& mesh = p.add_object();
  add_triangle(mesh, {{{-1, -1, -4}, {6, -4, -20}, {0, 3, -10}}}, {{{0, 0, 1}, {0.6, 0, 0.8}, {0, 0.6, 0.8}}});
  const frame::ExactFrame out = p.render_as(Reference::ideal);
  std::array<glm::dvec2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec4 clip = p.pose.eye_to_clip * glm::dvec4(mesh.positions[i], 1.0);
    corners[i] = {(clip.x / clip.w + 1) * 20 - 0.5, (1 - clip.y / clip.w) * 15 - 0.5};
  }
  const glm::dmat3 screen{glm::dvec3(corners[0], 1), glm::dvec3(corners[1], 1), glm::dvec3(corners[2], 1)};
  std::size_t compared = 0;
  for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
    if (out.object[pixel] == 0) continue;
    const glm::dvec3 weights =
        glm::inverse(screen) * glm::dvec3(static_cast<double>(pixel % 40), static_cast<double>(pixel / 40), 1);
    const glm::dvec3 n = glm::normalize(mean_of(mesh.normals, {0, 1, 2}, weights));
    // N.L = .6 x + .8 z; (N.H)^4 = (x + 3 z)^4 / 100
    const double level = 255 * (0.1 + 0.5 * (0.6 * n.x + 0.8 * n.z) + 0.4 * std::pow(n.x + 3 * n.z, 4) / 100);
    expect_near(rgb_at(out, pixel % 40, pixel / 40), glm::dvec3(std::min(level, 255.0)), 1e-9,
                "pixel " + std::to_string(pixel));
    ++compared;
  }
  EXPECT_GT(compared, 50U);
}

}  // namespace
}  // namespace rastertlm::reference
