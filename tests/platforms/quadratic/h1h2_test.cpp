// Does the quadratic machine's h1h2 test split what holds a highlight's centre, down to its limit, and evaluate no
// light for it?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm {
namespace {

constexpr int kLimit = 3;

run::Inputs inputs_with(const std::string& towards, int limit = kLimit) {
  return test::sphere_inputs("168",
                             {"set_up.method=quadratic_adaptive", "highlight_test.points=h1h2",
                              "highlight_test.depth_limit=" + std::to_string(limit), "light[0].towards=" + towards});
}

struct Lit {
  std::vector<set_up::ColourTriangle> triangles;
  set_up::ColourCounts colour;
  std::uint64_t evaluations = 0;
};
Lit lit(const run::Inputs& inputs) {
  Lit all;
  test::visit_triangles(inputs, [&](const host::SetUpWork& work) {
    all.triangles.insert(all.triangles.end(), work.coloured().begin(), work.coloured().end());
    all.colour = work.counts().colour;
    all.evaluations = work.counts().lighting.evaluations;
  });
  return all;
}

// Where the triangles' normals, linear on them, are half way between light and viewer: by a linear system, in the
// pixels of a screen on which a world unit is one.
std::optional<glm::dvec2> centre_on_screen(const run::Inputs& inputs) {
  const scene::Scene& scene = *inputs.content->scene;
  const scene::Pose pose = scene::pose(scene, 0, 512, 512);
  const glm::dvec3 halfway = glm::normalize(pose.lights[0].vector) + glm::dvec3(0, 0, 1);
  const geometry::Mesh& mesh = scene.objects[0].mesh;
  for (const auto& corner : mesh.triangles) {
    const auto normal = [&](int i) { return glm::normalize(pose.normal_to_eye[0] * mesh.normals[corner[i]]); };
    const glm::dmat3 normals(normal(0), normal(1), normal(2));
    if (std::fabs(glm::determinant(normals)) < 1e-9) continue;
    glm::dvec3 weights = glm::inverse(normals) * halfway;
    if (weights.x < 0 || weights.y < 0 || weights.z < 0) continue;
    weights /= weights.x + weights.y + weights.z;
    glm::dvec4 at(0.0);
    for (int i = 0; i < 3; ++i) at += weights[i] * (pose.object_to_eye[0] * glm::dvec4(mesh.positions[corner[i]], 1.0));
    return glm::dvec2(255.5 + at.x, 255.5 - at.y);
  }
  return std::nullopt;
}

double doubled_area(const set_up::ColourTriangle& t) {
  const auto& [a, b, c] = t.corners;
  return std::fabs(std::ldexp(static_cast<double>(geometry::doubled_area(a, b, c)), -2 * t.fraction_bits));
}

bool holds(const set_up::ColourTriangle& t, const glm::dvec2& point) {
  const double unit = std::ldexp(1.0, -t.fraction_bits);
  bool left = true, right = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = t.corners[i], &b = t.corners[(i + 1) % 3];
    const double x = static_cast<double>(a.x) * unit, y = static_cast<double>(a.y) * unit;
    const double side = static_cast<double>(b.x - a.x) * (point.y - y) - static_cast<double>(b.y - a.y) * (point.x - x);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right;
}

const char* const kTowards[] = {"[0.5, -1.0, -0.6]", "[0.1, -1.0, 0.3]", "[-0.9, -1.0, 0.2]", "[-0.4, -0.8, -0.5]",
                                "[0.7, -0.6, 0.7]"};

TEST(H1AndH2, SplitDownToTheCentre) {
  for (const char* towards : kTowards) {
    const Lit whole = lit(inputs_with(towards, 0)), split = lit(inputs_with(towards));
    const auto centre = centre_on_screen(inputs_with(towards));
    ASSERT_TRUE(centre.has_value()) << towards;
    const auto area_at_centre = [&](const Lit& of) {
      for (const set_up::ColourTriangle& t : of.triangles)
        if (holds(t, *centre)) return doubled_area(t);
      return 0.0;
    };
    EXPECT_NEAR(area_at_centre(whole) / area_at_centre(split), std::pow(4.0, kLimit), 1e-6) << towards;
    EXPECT_GE(split.colour.at_limit, 1U);
    // It is a test of the place: most triangles are left as they are.
    EXPECT_LT(whole.colour.at_limit, whole.colour.drawn / 8) << towards;
  }
}

// Six points a triangle, nine more a split, none to test.
TEST(H1AndH2, EvaluateNoLight) {
  const Lit all = lit(inputs_with(kTowards[0]));
  EXPECT_GT(all.colour.splits, 3U);
  EXPECT_EQ(all.colour.tests, 0U);
  EXPECT_EQ(all.evaluations, 6 * (all.colour.drawn - 3 * all.colour.splits) + 9 * all.colour.splits);
}

}  // namespace
}  // namespace rastertlm
