// Do the parts of a triangle that is cut up cover what it covered, once, and shine where the light does?
#include "modules/set_up/subdivision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "modules/set_up/span_load.h"
#include "modules/span_unit/span_unit.h"

namespace rastertlm::set_up::test {
namespace {

constexpr std::uint32_t kSide = 200;

class SubdivisionTest : public testing::Test {
 protected:
  std::mt19937_64 random_{47};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 direction() {
    return glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + glm::dvec3(0.01, 0, 0));
  }

  static SetUpParameters parameters(ShadingMethod method) {
    SetUpParameters p;
    p.method = method;
    p.attributes = Attributes::perspective;
    return p;
  }
  // Two lights near the surface, one far away.
  std::vector<geometry::LightSource> lights() {
    return {{true, {uniform(-6, 6), uniform(-6, 6), uniform(-8, 0)}, glm::dvec3(0.5), glm::dvec3(0.7)},
            {true, {uniform(-6, 6), uniform(-6, 6), uniform(-8, 0)}, glm::dvec3(0.3), glm::dvec3(0.5)},
            {false, glm::normalize(direction() + glm::dvec3(0, 0, 1.5)), glm::dvec3(0.2), glm::dvec3(0.4)}};
  }
  static std::vector<geometry::Reflectance> surfaces() {
    return {{glm::dvec3(0.05), glm::dvec3(0.3), glm::dvec3(0.5), 20}};
  }

  // Seen at (-x / z, -y / z) from the origin, with normals that turn by some forty degrees.
  LitTriangle triangle(const SetUpParameters& p, PointLighting& lighting) {
    LitTriangle corners;
    const double unit = static_cast<double>(std::int64_t{1} << p.snap_bits);
    const int finer = p.corner_bits() - static_cast<int>(p.snap_bits);
    const glm::dvec3 turned = glm::normalize(glm::dvec3(uniform(-0.7, 0.7), uniform(-0.7, 0.7), 1.0));
    for (LitCorner& corner : corners) {
      const double z = uniform(-6, -4), x = uniform(0, kSide - 1), y = uniform(0, kSide - 1);
      corner.point.at = {static_cast<std::int64_t>(x * unit) << finer, static_cast<std::int64_t>(y * unit) << finer};
      corner.point.inverse_w = -1.0 / z;
      corner.point.position = {(x / 100 - 1) * -z, (1 - y / 100) * -z, z};
      corner.point.normal = glm::normalize(turned + 0.4 * direction());
      corner.depth = 1e6 * (7 + z);
    }
    if (geometry::doubled_area(corners[0].point.at, corners[1].point.at, corners[2].point.at) > 0)
      std::swap(corners[1], corners[2]);
    for (LitCorner& corner : corners) corner.levels = lighting.levels(corner.point, 0);
    return corners;
  }
};

std::vector<int> covered_by(const std::vector<LitTriangle>& parts, const SetUpParameters& p) {
  std::vector<int> count(kSide * kSide);
  const span_unit::SpanUnitParameters unit_parameters;
  span_unit::SpanUnit unit(unit_parameters, kSide, kSide);
  for (const LitTriangle& part : parts) {
    ColourTriangle t;
    t.fraction_bits = p.corner_bits();
    for (std::size_t i = 0; i < 3; ++i) t.corners[i] = part[i].point.at;
    if (geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2]) == 0) continue;
    for (const span_unit::Span& span : unit.draw(span_load(t, SpanFormat::of(unit_parameters, kSide))).spans)
      for (std::uint32_t x = 0; x < span.count; ++x) ++count[span.line * kSide + span.column + x];
  }
  return count;
}

std::int64_t doubled_area(const LitTriangle& t) {
  return geometry::doubled_area(t[0].point.at, t[1].point.at, t[2].point.at);
}

class Parts : public SubdivisionTest, public testing::WithParamInterface<ShadingMethod> {};

TEST_P(Parts, CoverWhatTheWholeCoveredOnce) {
  const SetUpParameters p = parameters(GetParam());
  PointLighting lighting(p, surfaces(), {});
  Subdivision subdivision(p, lighting);
  std::size_t divided = 0;
  for (int round = 0; round < 150; ++round) {
    lighting.set_lights(lights(), true);
    const LitTriangle whole = triangle(p, lighting);
    if (doubled_area(whole) == 0) continue;
    std::vector<LitTriangle> parts;
    GetParam() == ShadingMethod::regular_subdivision ? subdivision.regular(whole, 0, parts)
                                                     : subdivision.highlight(whole, 0, parts);
    std::int64_t area = 0;
    for (const LitTriangle& part : parts) {
      ASSERT_LE(doubled_area(part), 0) << "turned over";
      area += doubled_area(part);
      for (const LitCorner& corner : part) {
        const auto levels = lighting.levels(corner.point, 0);
        for (int c = 0; c < 3; ++c) ASSERT_EQ(corner.levels[c], levels[c]);
      }
    }
    ASSERT_EQ(area, doubled_area(whole));
    ASSERT_EQ(covered_by(parts, p), covered_by({whole}, p));
    divided += parts.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(divided, 60U);
  EXPECT_EQ(subdivision.counts().divided, divided);
  EXPECT_GT(subdivision.operations().flops(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Both, Parts,
                         testing::Values(ShadingMethod::regular_subdivision, ShadingMethod::highlight_subdivision),
                         [](const auto& one) { return std::string(traits_of(one.param).name); });

TEST_F(SubdivisionTest, RegularPartsAreSmallerThanTheThreshold) {
  SetUpParameters p = parameters(ShadingMethod::regular_subdivision);
  PointLighting lighting(p, surfaces(), {});
  lighting.set_lights(lights(), true);
  for (const double threshold : {8.0, 32.0, 500.0}) {
    p.area_pixels = threshold;
    Subdivision subdivision(p, lighting);
    for (int round = 0; round < 50; ++round) {
      const LitTriangle whole = triangle(p, lighting);
      std::vector<LitTriangle> parts;
      subdivision.regular(whole, 0, parts);
      const double unit = std::ldexp(1.0, -2 * p.corner_bits());
      const double area = -0.5 * unit * static_cast<double>(doubled_area(whole));
      const auto count = static_cast<double>(parts.size());
      EXPECT_LT(area / count, threshold);
      EXPECT_TRUE(parts.size() == 1 || area / count * 4 >= threshold);
      const double level = std::log2(count) / 2;
      EXPECT_EQ(level, std::floor(level));
    }
    EXPECT_EQ(subdivision.counts().at_limit, 0U);
  }
  p.area_pixels = 0.25;
  p.depth_limit = 2;
  Subdivision limited(p, lighting);
  std::vector<LitTriangle> parts;
  limited.regular(triangle(p, lighting), 0, parts);
  EXPECT_EQ(parts.size(), 16U);
  EXPECT_EQ(limited.counts().at_limit, 1U);
}

// The brightest corner of what is cut at a highlight is at least as bright as anything on a fine grid, nearly.
TEST_F(SubdivisionTest, HighlightsGetACorner) {
  SetUpParameters p = parameters(ShadingMethod::highlight_subdivision);
  p.clamp_knots = false;
  p.intensity_error = 100.0;
  PointLighting lighting(p, {{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(1.0), 100}}, {});
  Subdivision subdivision(p, lighting);
  int compared = 0;
  for (int round = 0; round < 300; ++round) {
    lighting.set_lights({{true, {uniform(-6, 6), uniform(-6, 6), uniform(-2, 2)}, glm::dvec3(1.0), glm::dvec3(1.0)}},
                        true);
    const LitTriangle whole = triangle(p, lighting);
    std::vector<LitTriangle> parts;
    const std::uint64_t before = subdivision.counts().centres;
    subdivision.highlight(whole, 0, parts);
    if (subdivision.counts().centres == before) continue;
    double brightest = 0.0;
    for (const LitTriangle& part : parts)
      for (const LitCorner& corner : part) brightest = std::max(brightest, corner.levels.x);
    double exact = 0.0;
    constexpr int kGrid = 100;
    for (int i = 0; i <= kGrid; ++i)
      for (int j = 0; i + j <= kGrid; ++j) {
        const double a = static_cast<double>(i) / kGrid, b = static_cast<double>(j) / kGrid;
        const LitPoint point = lighting.inside({&whole[0].point, &whole[1].point, &whole[2].point}, {a, b, 1 - a - b});
        exact = std::max(exact, lighting.levels(point, 0).x);
      }
    ++compared;
    EXPECT_GT(brightest, 0.9 * exact);
  }
  EXPECT_GT(compared, 20);
}

// Nothing to find: no normals, no light on the surface. The whole stays.
TEST_F(SubdivisionTest, LeavesWhatHasNoHighlight) {
  const SetUpParameters p = parameters(ShadingMethod::highlight_subdivision);
  PointLighting lighting(p, surfaces(), {});
  lighting.set_lights({{false, {0, 0, 1}, glm::dvec3(1.0), glm::dvec3(1.0)}}, true);
  Subdivision subdivision(p, lighting);
  LitTriangle whole = triangle(p, lighting);
  for (LitCorner& corner : whole) corner.point.normal = {0, 0, 0};
  std::vector<LitTriangle> parts;
  subdivision.highlight(whole, 0, parts);
  EXPECT_EQ(parts.size(), 1U);
  EXPECT_EQ(subdivision.counts().unfound, 1U);
  for (LitCorner& corner : whole) corner.point.normal = {0.3, 0, -1};  // turned away
  parts.clear();
  subdivision.highlight(whole, 0, parts);
  EXPECT_EQ(parts.size(), 1U);
}

TEST_F(SubdivisionTest, LeavesWhatReflectsNoSpecularLight) {
  const SetUpParameters p = parameters(ShadingMethod::highlight_subdivision);
  std::vector<geometry::Reflectance> both = surfaces();
  both.push_back(both[0]);
  both[1].specular = glm::dvec3(0.0);
  PointLighting lighting(p, both, {});
  std::size_t cut = 0;
  for (int round = 0; round < 50; ++round) {
    lighting.set_lights(lights(), true);
    Subdivision subdivision(p, lighting);
    const LitTriangle whole = triangle(p, lighting);
    std::vector<LitTriangle> shining, matt;
    subdivision.highlight(whole, 0, shining);
    cut += shining.size() > 1 ? 1 : 0;
    const geometry::OperationCounts before = subdivision.operations();
    subdivision.highlight(whole, 1, matt);
    EXPECT_EQ(matt.size(), 1U);
    EXPECT_EQ(subdivision.operations().flops(), before.flops());
  }
  EXPECT_GT(cut, 5U);
}

// Light and viewer in one direction, and normals so short that their products vanish.
TEST_F(SubdivisionTest, HasNoAnswerForNormalsThatNumbersDoNotHold) {
  SetUpParameters p = parameters(ShadingMethod::highlight_subdivision);
  PointLighting lighting(p, surfaces(), {});
  lighting.set_lights({{false, {0, 0, 1}, glm::dvec3(1.0), glm::dvec3(1.0)}}, false);
  LitTriangle whole = triangle(p, lighting);
  const glm::dvec3 normals[] = {{-0.3, -0.2, 1}, {0.5, -0.1, 1}, {0.0, 0.6, 1}};
  for (const double length : {1.0, 1e-50, 1e-200}) {
    Subdivision subdivision(p, lighting);
    for (std::size_t i = 0; i < 3; ++i) {
      whole[i].point.normal = length * normals[i];
      whole[i].levels = lighting.levels(whole[i].point, 0);
    }
    std::vector<LitTriangle> parts;
    subdivision.highlight(whole, 0, parts);
    const bool held = length > 1e-100;
    EXPECT_EQ(subdivision.counts().centres, held ? 1U : 0U) << length;
    EXPECT_EQ(subdivision.counts().unfound, held ? 0U : 1U) << length;
    EXPECT_EQ(parts.size() > 1, held) << length;
  }
}

}  // namespace
}  // namespace rastertlm::set_up::test
