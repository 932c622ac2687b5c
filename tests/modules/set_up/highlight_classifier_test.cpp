// Do the H1 and H2 tests find every triangle that holds a highlight's centre, where normals are linear, the light
// directional and the viewer infinitely far; and do their sides follow from angles?
#include "modules/set_up/highlight_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "modules/set_up/highlight_classifier.h"
#include "src/scene/primitives.h"

namespace rastertlm::set_up::test {
namespace {

class HighlightTest : public testing::Test {
 protected:
  std::mt19937_64 random_{41};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v = vector(1.0);
      const double length = glm::length(v);
      if (length > 0.1 && length < 1.0) return v / length;
    }
  }
  HighlightSource source() {
    HighlightSource s{uniform(0, 1) < 0.5, {}, uniform(0, 1) < 0.5, {}};
    s.light = s.light_at_point ? vector(5.0) : direction();
    s.viewer = s.viewer_at_point ? vector(5.0) : direction();
    return s;
  }
};

TEST_F(HighlightTest, SidesFollowFromAngles) {
  int away = 0;
  for (int round = 0; round < 5000; ++round) {
    const HighlightSource s = source();
    const glm::dvec3 p = vector(2.0), n = uniform(0.2, 3.0) * direction();
    const glm::dvec3 light = glm::normalize(s.light_at_point ? s.light - p : s.light);
    const glm::dvec3 viewer = glm::normalize(s.viewer_at_point ? s.viewer - p : s.viewer);
    const std::uint8_t sides = highlight_sides<double>(s, p, n);
    const double volume = glm::dot(glm::cross(light, viewer), n);
    const double angles =
        std::acos(glm::dot(light, glm::normalize(n))) - std::acos(glm::dot(viewer, glm::normalize(n)));
    if (std::fabs(volume) < 1e-9 || std::fabs(angles) < 1e-6) continue;
    EXPECT_EQ((sides & h1_positive) != 0, volume > 0);
    EXPECT_EQ((sides & h1_negative) != 0, volume < 0);
    EXPECT_EQ((sides & h2_positive) != 0, angles > 0);
    EXPECT_EQ((sides & h2_negative) != 0, angles < 0);
    const bool turned_away = glm::dot(light, n) < 0 && glm::dot(viewer, n) < 0;
    EXPECT_EQ((sides & not_turned_away) == 0, turned_away);
    away += turned_away ? 1 : 0;
  }
  EXPECT_GT(away, 500);
}

TEST_F(HighlightTest, BetweenIsOnBothSides) {
  constexpr std::uint8_t kBoth = h1_positive | h1_negative | h2_positive | h2_negative | not_turned_away;
  // The normal half way between the two; no normal; the light at the point; light and viewer in one direction.
  EXPECT_EQ(highlight_sides<double>({false, {1, 0, 1}, false, {-1, 0, 1}}, {}, {0, 0, 2}), kBoth);
  EXPECT_EQ(highlight_sides<double>({false, {1, 0, 1}, false, {-1, 0, 1}}, {}, {0, 0, 0}), kBoth);
  EXPECT_EQ(
      highlight_sides<double>({true, {1, 2, 3}, false, {-1, 0, 1}}, {1, 2, 3}, {1, 0, 2}) & (h1_positive | h1_negative),
      h1_positive | h1_negative);
  EXPECT_EQ(
      highlight_sides<double>({false, {0, 0, 2}, false, {0, 0, 1}}, {}, {0.3, 0.1, 1}) & (h1_positive | h1_negative),
      h1_positive | h1_negative);
}

// Normals linear on the triangle, constant directions: the centre, if there is one, is where the normal is a multiple
// of the halfway vector, which a system of linear equations gives.
TEST_F(HighlightTest, NeverMissesACentreOfLinearNormals) {
  int centres = 0, passed = 0;
  for (int round = 0; round < 20000; ++round) {
    const HighlightSource s{false, direction(), false, direction()};
    const glm::dvec3 halfway = glm::normalize(s.light) + glm::normalize(s.viewer);
    std::array<glm::dvec3, 3> n;
    for (auto& normal : n) normal = direction() + 1.5 * halfway;
    const glm::dvec3 weights = glm::inverse(glm::dmat3(n[0], n[1], n[2])) * halfway;
    const bool inside = weights.x >= 0 && weights.y >= 0 && weights.z >= 0;
    std::array<std::uint8_t, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) sides[i] = highlight_sides<double>(s, vector(1.0), n[i]);
    const bool found = may_be_highlighted(sides[0], sides[1], sides[2]);
    EXPECT_TRUE(found || !inside);
    centres += inside ? 1 : 0;
    passed += found ? 1 : 0;
  }
  EXPECT_GT(centres, 1000);
  EXPECT_LT(passed, 20000 * 3 / 4);  // it does tell them apart
}

// The largest cosine between the normal, linear on the triangle, and a direction: looked for everywhere on a grid, then
// ever nearer about the best point. Nothing but the angle is asked for.
struct Nearest {
  double cosine = -1.0;
  glm::dvec3 weights{0.0};
};
Nearest nearest_normal(const std::array<glm::dvec3, 3>& n, const glm::dvec3& direction) {
  constexpr int kGrid = 24, kTurns = 60;
  Nearest best;
  const auto look = [&](double v, double w) {
    if (v < 0 || w < 0 || v + w > 1) return;
    const glm::dvec3 normal = (1 - v - w) * n[0] + v * n[1] + w * n[2];
    const double cosine = glm::dot(normal, direction) / glm::length(normal);
    if (cosine > best.cosine) best = {cosine, {1 - v - w, v, w}};
  };
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; i + j <= kGrid; ++j) look(static_cast<double>(i) / kGrid, static_cast<double>(j) / kGrid);
  double step = 1.0 / kGrid;
  for (int turn = 0; turn < kTurns; ++turn) {
    const glm::dvec3 at = best.weights;
    const double before = best.cosine;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) look(at.y + i * step * 0.5, at.z + j * step * 0.5);
    if (best.cosine <= before) step *= 0.5;
  }
  return best;
}

// Recall is 1 where light and viewer are infinitely far: normals of any length and direction, whole spheres of them, on
// random triangles against that search.
TEST_F(HighlightTest, NeverMissesWhatASearchOfEveryPointFinds) {
  int centres = 0, passed = 0;
  constexpr int kRounds = 6000;
  for (int round = 0; round < kRounds; ++round) {
    const HighlightSource s{false, direction() * uniform(0.1, 9.0), false, direction() * uniform(0.1, 9.0)};
    const glm::dvec3 light = glm::normalize(s.light), viewer = glm::normalize(s.viewer);
    if (glm::length(light + viewer) < 0.05) continue;
    const glm::dvec3 halfway = glm::normalize(light + viewer);
    const double towards = uniform(0.0, 1.5);
    std::array<glm::dvec3, 3> n;
    for (auto& normal : n) normal = (direction() + towards * halfway) * uniform(0.05, 20.0);
    std::array<std::uint8_t, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) sides[i] = highlight_sides<double>(s, vector(1.0), n[i]);
    const bool found = may_be_highlighted(sides[0], sides[1], sides[2]);
    passed += found ? 1 : 0;
    constexpr double kCentre = 1e-12;
    if (nearest_normal(n, halfway).cosine < 1 - kCentre) continue;
    ++centres;
    EXPECT_TRUE(found) << "round " << round;
  }
  EXPECT_GT(centres, kRounds / 10);
  EXPECT_GT(passed, centres);
  EXPECT_LT(passed, kRounds * 3 / 4);
}

std::size_t marked(const std::vector<Highlighted>& triangles, Highlighted as) {
  return static_cast<std::size_t>(std::count(triangles.begin(), triangles.end(), as));
}

const std::vector<geometry::Reflectance> kShining{{{}, {}, glm::dvec3(0.5), 20}};
const std::vector<geometry::Reflectance> kShiningAndMatt{kShining[0], {glm::dvec3(0.1), glm::dvec3(0.7), {}, 20}};

// Of a sphere seen from far, with a light from far, one place shines, where the normal is half way.
TEST_F(HighlightTest, FindsTheOneHighlightOfASphere) {
  geometry::Mesh mesh = scene::uv_sphere(1.0, 23, 16);
  mesh.material.assign(mesh.triangles.size(), 0);
  HighlightClassifier classifier(mesh, kShining);
  for (int round = 0; round < 50; ++round) {
    const glm::dvec3 light = glm::normalize(direction() + glm::dvec3(0, 0, 1.5));
    const std::vector<geometry::LightSource> lights{{false, light, glm::dvec3(1.0), glm::dvec3(1.0)}};
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), uniform(0, 6), direction());
    const auto& triangles = classifier.classify(turned, {lights, false}, 0);
    const glm::dvec3 halfway = glm::normalize(light + glm::dvec3(0, 0, 1));
    std::size_t holding = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto corner = [&](int i) {
        return glm::dvec3(turned * glm::dvec4(mesh.normals[mesh.triangles[t][i]], 0.0));
      };
      const double volume = glm::determinant(glm::dmat3(corner(0), corner(1), corner(2)));
      if (std::fabs(volume) < 1e-12) continue;
      const glm::dvec3 weights = glm::inverse(glm::dmat3(corner(0), corner(1), corner(2))) * halfway;
      if (weights.x < 0 || weights.y < 0 || weights.z < 0) continue;
      ++holding;
      EXPECT_EQ(triangles[t], Highlighted::potentially) << t;
    }
    EXPECT_GE(holding, 1U);
    EXPECT_LT(marked(triangles, Highlighted::potentially), mesh.triangles.size() / 8);
  }
}

// A surface without specular light has no highlight, wherever the light stands; all others are found as before.
TEST_F(HighlightTest, LeavesMattTrianglesAlone) {
  geometry::Mesh mesh = scene::uv_sphere(1.0, 23, 16);
  mesh.material.assign(mesh.triangles.size(), 0);
  HighlightClassifier shining(mesh, kShining);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.material[t] = static_cast<std::uint16_t>(t % 2);
  HighlightClassifier mixed(mesh, kShiningAndMatt);
  std::size_t left_alone = 0;
  for (int round = 0; round < 20; ++round) {
    const std::vector<geometry::LightSource> lights{
        {false, glm::normalize(direction() + glm::dvec3(0, 0, 1.5)), glm::dvec3(1.0), glm::dvec3(1.0)}};
    const std::vector<Highlighted> all = shining.classify(glm::dmat4(1.0), {lights, false}, 0);
    const std::vector<Highlighted> some = mixed.classify(glm::dmat4(1.0), {lights, false}, 0);
    for (std::size_t t = 0; t < all.size(); ++t) {
      EXPECT_EQ(some[t], t % 2 == 0 ? all[t] : Highlighted::no) << t;
      left_alone += all[t] != some[t] ? 1 : 0;
    }
  }
  EXPECT_GT(left_alone, 0U);
}

TEST_F(HighlightTest, IsTheSameInEyeSpaceAndCountsItsOperations) {
  geometry::Mesh mesh = scene::uv_sphere(1.0, 17, 12);
  mesh.material.assign(mesh.triangles.size(), 0);
  HighlightClassifier classifier(mesh, kShining);
  const std::vector<geometry::LightSource> lights{{true, {3, 2, -1}, glm::dvec3(1.0), glm::dvec3(1.0)},
                                                  {false, {0, 0.6, 0.8}, glm::dvec3(1.0), glm::dvec3(1.0)}};
  const glm::dmat4 placed = glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.1, -6.0)) *
                            glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.6, 0.8, 0.0)) *
                            glm::scale(glm::dmat4(1.0), glm::dvec3(1.7));
  const std::vector<Highlighted> in_model = classifier.classify(placed, {lights, true}, 1);
  const geometry::OperationCounts cheap = classifier.operations();
  // A scale that is off by next to nothing makes it go to eye space.
  const glm::dmat4 stretched = placed * glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 1.0 + 1e-7));
  EXPECT_EQ(classifier.classify(stretched, {lights, true}, 1), in_model);
  EXPECT_GT(classifier.operations().flops(), cheap.flops() + 20 * mesh.positions.size());
  EXPECT_EQ(classifier.counts().tested, mesh.triangles.size());
  EXPECT_EQ(classifier.counts().potentially, marked(in_model, Highlighted::potentially));
  EXPECT_EQ(classifier.counts().neighbours, marked(in_model, Highlighted::neighbour));
  // One light: half of what vertices take.
  classifier.classify(placed, {std::span(lights).first(1), true}, 1);
  EXPECT_LT(classifier.operations().flops() * 19, cheap.flops() * 10);
}

// Against the definition, pair by pair.
TEST_F(HighlightTest, RingsAreThoseThatShareAVertexPosition) {
  const geometry::Mesh mesh = scene::teapot(4, 28);
  const Neighbourhood neighbourhood(mesh);
  const auto shares = [&](std::size_t a, std::size_t b) {
    for (const std::uint32_t i : mesh.triangles[a])
      for (const std::uint32_t j : mesh.triangles[b])
        if (mesh.positions[i] == mesh.positions[j]) return true;
    return false;
  };
  std::vector<Highlighted> triangles(mesh.triangles.size(), Highlighted::no);
  for (const std::size_t t : {std::size_t{5}, std::size_t{400}, std::size_t{777}})
    triangles[t] = Highlighted::potentially;
  std::vector<Highlighted> widened = triangles, twice = triangles;
  neighbourhood.widen(1, widened);
  neighbourhood.widen(2, twice);
  std::size_t first = 0, second = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    bool beside = false, beside_widened = false;
    for (std::size_t u = 0; u < triangles.size(); ++u) {
      beside = beside || (triangles[u] == Highlighted::potentially && shares(t, u));
      beside_widened = beside_widened || (widened[u] != Highlighted::no && shares(t, u));
    }
    EXPECT_EQ(widened[t] != Highlighted::no, beside);
    EXPECT_EQ(twice[t] != Highlighted::no, beside_widened);
    first += beside ? 1 : 0;
    second += beside_widened ? 1 : 0;
  }
  EXPECT_GT(first, 15U);
  EXPECT_GT(second, first);
}

}  // namespace
}  // namespace rastertlm::set_up::test
