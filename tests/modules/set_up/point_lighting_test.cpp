// Is light at a point the lighting equation's, do points between corners lie on the surface, and does it cost what the
// equation's own code counts?
#include "modules/set_up/point_lighting.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace rastertlm::set_up::test {
namespace {

using Number = geometry::Counted<double>;

class PointLightingTest : public testing::Test {
 protected:
  std::mt19937_64 random_{13};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 direction() { return glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))); }
  std::vector<geometry::LightSource> lights() {
    std::vector<geometry::LightSource> all;
    all.reserve(3);
    for (int i = 0; i < 3; ++i)
      all.push_back({i == 1, i == 1 ? 5.0 * direction() : direction(), glm::dvec3(0.4), glm::dvec3(0.3)});
    return all;
  }
  std::vector<geometry::Reflectance> surfaces() {
    return {{glm::dvec3(0.05), glm::dvec3(0.2), glm::dvec3(0.2), 7},
            {glm::dvec3(0.1), glm::dvec3(0.1), glm::dvec3(0.3), 20}};
  }
};

// What the equation does with Counted numbers, the normalisations and the scaling to levels included.
geometry::OperationCounts counted(const geometry::Reflectance& surface,
                                  const std::vector<geometry::LightSource>& lights,
                                  const geometry::LightingRules& rules, const LitPoint& point, bool at_eye) {
  const geometry::OperationCounts before = geometry::operation_counts;
  const auto of = [](const glm::dvec3& v) { return geometry::Vector3<Number>(v.x, v.y, v.z); };
  const auto normal = geometry::normalised<Number>(of(point.normal));
  const auto viewer = at_eye ? geometry::normalised<Number>(of(-point.position)) : of({0, 0, 1});
  geometry::illumination<Number>(surface, lights, rules, normal, viewer, of(point.position));
  geometry::OperationCounts counts = geometry::operation_counts - before;
  counts.multiply += 3;
  counts.compare += 6;
  return counts;
}

TEST_F(PointLightingTest, IsTheLightingEquationAndCostsWhatItCounts) {
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (const bool gate : {false, true})
      for (const bool at_eye : {false, true}) {
        SetUpParameters parameters;
        parameters.attributes = at_eye ? Attributes::perspective : Attributes::linear;
        const geometry::LightingRules rules{model, gate, glm::dvec3(0.8)};
        PointLighting lighting(parameters, surfaces(), rules);
        for (int round = 0; round < 300; ++round) {
          const auto sources = lights();
          lighting.set_lights(sources, at_eye);
          LitPoint point;
          point.normal = uniform(0.3, 1.0) * direction();
          point.position = 4.0 * direction();
          const std::size_t material = round % 2;
          const glm::dvec3 viewer = at_eye ? glm::normalize(-point.position) : glm::dvec3(0, 0, 1);
          const glm::dvec3 light = geometry::illumination<double>(surfaces()[material], sources, rules,
                                                                  glm::normalize(point.normal), viewer, point.position);
          const geometry::OperationCounts before = lighting.operations();
          const glm::dvec3 levels = lighting.levels(point, material);
          for (int c = 0; c < 3; ++c) ASSERT_NEAR(levels[c], std::min(255 * light[c], 255.0), 1e-9);
          ASSERT_EQ(lighting.operations() - before, counted(surfaces()[material], sources, rules, point, at_eye));
        }
        EXPECT_EQ(lighting.counts().evaluations, 300U);
      }
}

// The eye at the origin looks along -z: what is at p is seen at p.xy / -p.z.
LitPoint seen(const glm::dvec3& position, const glm::dvec3& normal) {
  LitPoint point;
  point.position = position;
  point.normal = normal;
  point.inverse_w = -1.0 / position.z;
  return point;
}
glm::dvec2 on_screen(const LitPoint& point) {
  return {-point.position.x / point.position.z, -point.position.y / point.position.z};
}

TEST_F(PointLightingTest, PointsBetweenCornersAreWhereTheScreenHasThem) {
  SetUpParameters parameters;
  parameters.attributes = Attributes::perspective;
  PointLighting lighting(parameters, surfaces(), {});
  lighting.set_lights(lights(), true);
  for (int round = 0; round < 200; ++round) {
    const auto corner = [&] { return seen({uniform(-2, 2), uniform(-2, 2), uniform(-9, -1)}, direction()); };
    const LitPoint a = corner(), b = corner(), c = corner();
    const LitPoint middle = lighting.middle(a, b);
    const glm::dvec2 wanted = 0.5 * (on_screen(a) + on_screen(b));
    ASSERT_LT(glm::distance(on_screen(middle), wanted), 1e-12);
    ASSERT_NEAR(middle.inverse_w, -1.0 / middle.position.z, 1e-12);
    const LitPoint inside = lighting.inside({&a, &b, &c}, {0.2, 0.3, 0.5});
    ASSERT_LT(glm::distance(on_screen(inside), 0.2 * on_screen(a) + 0.3 * on_screen(b) + 0.5 * on_screen(c)), 1e-12);
    // The normal goes the way that the position goes.
    const double share = glm::distance(a.position, middle.position) / glm::distance(a.position, b.position);
    ASSERT_LT(glm::distance(middle.normal, a.normal + share * (b.normal - a.normal)), 1e-9);
  }
}

TEST_F(PointLightingTest, WhatIsNoNumberIsBlackAndCounted) {
  PointLighting lighting({}, surfaces(), {});
  auto sources = lights();
  sources[0].diffuse_intensity.x = std::numeric_limits<double>::infinity();
  sources[0].specular_intensity.x = -std::numeric_limits<double>::infinity();
  sources[0].vector = {0, 0, 1};
  lighting.set_lights(sources, false);
  const glm::dvec3 levels = lighting.levels({}, 0);
  EXPECT_EQ(levels.x, 0.0);
  EXPECT_GT(levels.y, 0.0);
  EXPECT_EQ(lighting.counts().not_finite, 1U);
}

}  // namespace
}  // namespace rastertlm::set_up::test
