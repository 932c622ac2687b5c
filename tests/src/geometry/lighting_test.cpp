// Is the lighting equation the paper's? Ten normals worked by hand, both models, gate on and off, lights at a point.
#include "src/geometry/lighting.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace rastertlm::geometry {
namespace {

constexpr glm::dvec3 kViewer{0, 0, 1};
constexpr glm::dvec3 kLight{0.6, 0, 0.8};

// By hand, with L = (.6, 0, .8), V = (0, 0, 1) and E = 4:
//   N.L       = .6 x + .8 z
//   H         = (L + V) / |L + V| = (1, 0, 3) / sqrt(10), so (N.H)^4 = (x + 3 z)^4 / 100 where x + 3 z > 0
//   R.V       = 2 (N.L) z - .8, R = 2 (N.L) N - L
struct Case {
  glm::dvec3 normal;
  double diffuse;  // max(N.L, 0)
  double blinn;    // max(N.H, 0)^4
  double phong;    // max(R.V, 0)^4
  bool lit;        // N.L > 0
};

const std::array<Case, 10> kCases{{
    {{0, 0, 1}, 0.8, 0.81, 0.4096, true},                          // x+3z = 3;   R.V = .8
    {{0.6, 0, 0.8}, 1.0, 0.81, 0.4096, true},                      // N = L:      x+3z = 3;   R.V = 1.6 - .8
    {{1, 0, 0}, 0.6, 0.01, 0, true},                               // x+3z = 1;   R.V = -.8
    {{-0.6, 0, 0.8}, 0.28, 0.104976, 0, true},                     // x+3z = 1.8; R.V = .448 - .8
    {{0, 1, 0}, 0, 0, 0, false},                                   // across both: x+3z = 0;  R.V = -.8
    {{0, 0.6, 0.8}, 0.64, 0.331776, 0.002517630976, true},         // x+3z = 2.4; R.V = .224
    {{0.8, 0, 0.6}, 0.96, 0.456976, 0.015352201216, true},         // x+3z = 2.6; R.V = .352
    {{-0.8, 0, 0.6}, 0, 0.01, 0, false},                           // N.L = 0:    x+3z = 1;   R.V = -.8
    {{-12.0 / 13, 0, 5.0 / 13}, 0, 81.0 / 28561 / 100, 0, false},  // N.L = -3.2/13: x+3z = 3/13; R.V < 0
    {{-0.6, 0, -0.8}, 0, 0, 0.4096, false},                        // N = -L:     x+3z = -3;  R.V = 1.6 - .8
}};

const Reflectance kSurface{{0.1, 0.05, 0.025}, {0.5, 0.25, 0.125}, {0.4, 0.4, 0.4}, 4};
constexpr glm::dvec3 kIntensity{1.0, 0.8, 0.5};
constexpr glm::dvec3 kAmbientLight{1.0, 0.5, 2.0};

glm::dvec3 by_hand(const Case& c, Model model, bool gate) {
  const double highlight = gate && !c.lit ? 0.0 : (model == Model::blinn ? c.blinn : c.phong);
  glm::dvec3 sum;
  for (int i = 0; i < 3; ++i)
    sum[i] = kSurface.ambient[i] * kAmbientLight[i] +
             kIntensity[i] * (kSurface.diffuse[i] * c.diffuse + kSurface.specular[i] * highlight);
  return sum;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-15) << what << ", channel " << i;
}

TEST(Lighting, TenNormalsByHand) {
  const std::vector<LightSource> lights{{false, kLight, kIntensity, kIntensity}};
  for (const Model model : {Model::blinn, Model::phong}) {
    for (const bool gate : {false, true}) {
      const LightingRules rules{model, gate, kAmbientLight};
      for (std::size_t i = 0; i < kCases.size(); ++i) {
        const glm::dvec3 light = illumination<double>(kSurface, lights, rules, kCases[i].normal, kViewer, {9, 9, 9});
        expect_near(
            light, by_hand(kCases[i], model, gate),
            "normal " + std::to_string(i) + (gate ? " gated" : "") + (model == Model::blinn ? " blinn" : " phong"));
      }
    }
  }
}

// A light 5 units away along L from the point that is lit is the same as one in direction L.
TEST(Lighting, ALightAtAPointByHand) {
  const glm::dvec3 position{1, 2, 3};
  const std::vector<LightSource> lights{{true, {4, 2, 7}, kIntensity, kIntensity}};
  for (const Model model : {Model::blinn, Model::phong})
    for (std::size_t i = 0; i < kCases.size(); ++i)
      expect_near(
          illumination<double>(kSurface, lights, {model, false, kAmbientLight}, kCases[i].normal, kViewer, position),
          by_hand(kCases[i], model, false), "normal " + std::to_string(i));
}

// L = (-.6, 0, .8), V = (.6, 0, .8): H and N are (0, 0, 1) and R is V, so both highlights are full; diffuse .8.
TEST(Lighting, AViewerElsewhereByHand) {
  const std::vector<LightSource> lights{{false, {-0.6, 0, 0.8}, kIntensity, kIntensity}};
  const Case full{{0, 0, 1}, 0.8, 1.0, 1.0, true};
  for (const Model model : {Model::blinn, Model::phong})
    expect_near(illumination<double>(kSurface, lights, {model, false, kAmbientLight}, full.normal, {0.6, 0, 0.8}, {}),
                by_hand(full, model, false), "mirror direction");
}

TEST(Lighting, LightsAddUpAndTheirSpecularIntensityIsApart) {
  const glm::dvec3 mean(0.25);
  const std::vector<LightSource> lights{{false, kLight, kIntensity, mean}, {false, kViewer, kIntensity, mean}};
  const glm::dvec3 light =
      illumination<double>(kSurface, lights, {Model::blinn, false, kAmbientLight}, kViewer, kViewer, {});
  for (int i = 0; i < 3; ++i)  // N.L = .8 and 1, (N.H)^4 = .81 and 1
    EXPECT_NEAR(light[i],
                kSurface.ambient[i] * kAmbientLight[i] + kSurface.diffuse[i] * kIntensity[i] * 1.8 + 0.4 * 0.25 * 1.81,
                1e-15);
}

TEST(Lighting, AZeroNormalAndALightBehindTheSurfaceSeeAmbientOnly) {
  const glm::dvec3 ambient{0.1, 0.025, 0.05};
  const std::vector<LightSource> lights{{false, kLight, kIntensity, kIntensity}};
  const std::vector<LightSource> opposite{{false, -kViewer, kIntensity, kIntensity}};  // L + V = 0: no half vector
  for (const Model model : {Model::blinn, Model::phong}) {
    expect_near(illumination<double>(kSurface, lights, {model, false, kAmbientLight}, glm::dvec3(0.0), kViewer, {}),
                ambient, "zero normal");
    expect_near(illumination<double>(kSurface, opposite, {Model::blinn, false, kAmbientLight}, kViewer, kViewer, {}),
                ambient, "light behind");
  }
}

TEST(Lighting, IntegerPowersAreExactProducts) {
  EXPECT_EQ(integer_power(0.5, 0), 1.0);
  for (int e = 1; e <= 200; ++e) {
    EXPECT_EQ(integer_power(0.5, e), std::ldexp(1.0, -e));
    EXPECT_NEAR(integer_power(0.99, e), std::pow(0.99, e), 1e-14);
  }
}

TEST(Lighting, NormalisingKeepsTheDirection) {
  const glm::dvec3 unit = normalised<double>({3, -4, 12});
  expect_near(unit, {3.0 / 13, -4.0 / 13, 12.0 / 13}, "3-4-12");
  expect_near(normalised<double>({0, 0, 0}), {0, 0, 0}, "zero");
}

}  // namespace
}  // namespace rastertlm::geometry
