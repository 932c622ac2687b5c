// Are levels at several points at once those of one point after the other, to the last bit, at the same cost?
#include "modules/set_up/light_kernels.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "modules/set_up/point_lighting.h"

namespace rastertlm::set_up::test {
namespace {

struct Case {
  geometry::Model model;
  bool gate;
  bool clamp;
  std::size_t lights;
};

class LightKernels : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{29};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int count) { return std::uniform_int_distribution<int>(1, count)(random_) == 1; }
  glm::dvec3 direction() {
    return geometry::normalised<double>(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-0.3, 1)));
  }

  // Some are zero, of no number, or from behind; one light in six is brighter than full scale.
  LitPoint point() {
    LitPoint point;
    point.normal = uniform(0.1, 2.0) * direction();
    if (one_in(12)) point.normal = {0, 0, 0};
    if (one_in(12)) point.normal = -point.normal;
    if (one_in(40)) point.normal.y = std::numeric_limits<double>::quiet_NaN();
    if (one_in(40)) point.normal = {1e200, 1e200, 0};
    return point;
  }
  std::vector<geometry::LightSource> lights(std::size_t count) {
    std::vector<geometry::LightSource> all;
    for (std::size_t i = 0; i < count; ++i) {
      const double bright = one_in(6) ? 3.0 : 0.4;
      all.push_back({false, direction(), glm::dvec3(bright, 0.3, 0.2), glm::dvec3(0.1, bright, 0.3)});
    }
    if (count > 0 && one_in(5)) all[0].diffuse_intensity.z = std::numeric_limits<double>::infinity();
    return all;
  }

  void compare(const Case& with, int rounds);
};

void LightKernels::compare(const Case& with, int rounds) {
  const std::vector<geometry::Reflectance> surfaces = {
      {glm::dvec3(0.05), glm::dvec3(0.2, 0.9, 0.1), glm::dvec3(0.2), 1},
      {glm::dvec3(0.1), glm::dvec3(0.1), glm::dvec3(0.7), 50},
      {glm::dvec3(-0.2, 0.0, 0.1), glm::dvec3(0.5), glm::dvec3(0.3), 23}};
  SetUpParameters parameters;
  parameters.clamp_knots = with.clamp;
  const geometry::LightingRules rules{with.model, with.gate, glm::dvec3(0.8, 1.0, 0.5)};
  PointLighting at_once(parameters, surfaces, rules, GetParam()), one_by_one(parameters, surfaces, rules);
  for (int round = 0; round < rounds; ++round) {
    const auto sources = lights(with.lights);
    at_once.set_lights(sources, false);
    one_by_one.set_lights(sources, false);
    std::vector<LitPoint> points(1 + static_cast<std::size_t>(round) % kLightLanes);
    for (LitPoint& p : points) p = point();
    std::vector<PointLighting::Levels> levels(points.size());
    const std::size_t material = static_cast<std::size_t>(round) % surfaces.size();
    at_once.levels(points, material, levels);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const PointLighting::Levels wanted = one_by_one.levels(points[i], material);
      for (int c = 0; c < 3; ++c) ASSERT_EQ(levels[i][c], wanted[c]) << "point " << i << ", channel " << c;
    }
    ASSERT_EQ(at_once.operations(), one_by_one.operations());
  }
  EXPECT_EQ(at_once.counts().evaluations, one_by_one.counts().evaluations);
  EXPECT_EQ(at_once.counts().clamped_knots, one_by_one.counts().clamped_knots);
  EXPECT_EQ(at_once.counts().not_finite, one_by_one.counts().not_finite);
  EXPECT_EQ(at_once.counts().clamped_knots > 0, with.clamp);
  EXPECT_EQ(at_once.counts().not_finite > 0, with.lights > 0);
}

TEST_P(LightKernels, GiveTheLevelsAndTheCostOfPointByPoint) {
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (const bool gate : {false, true})
      for (const bool clamp : {false, true})
        for (const std::size_t lights : {0U, 1U, 3U}) compare({model, gate, clamp, lights}, 150);
}

INSTANTIATE_TEST_SUITE_P(Variants, LightKernels, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::set_up::test
