// Is what the search finds a highlight's centre: does the normal there lie half way between light and viewer?
#include "modules/set_up/highlight_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>

namespace rastertlm::set_up::test {
namespace {

using Number = geometry::Counted<double>;
using Corners = std::array<SurfacePoint<double>, 3>;

class HighlightSearchTest : public testing::Test {
 protected:
  std::mt19937_64 random_{43};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 direction() {
    return glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + glm::dvec3(0.01, 0, 0));
  }

  // A piece of a sphere of radius 1 about the origin, `size` wide, with a light and a viewer whose highlight's centre
  // is in it, a given distance off.
  Corners piece(double size, HighlightSource& source, double distance) {
    Corners corners;
    const glm::dvec3 middle = direction(), u = glm::normalize(glm::cross(middle, direction())),
                     v = glm::cross(middle, u);
    const double turned = uniform(0, 6.28);
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = turned + 2.0943951 * static_cast<double>(i) + uniform(-0.4, 0.4);
      corners[i].position = glm::normalize(middle + size * (std::cos(angle) * u + std::sin(angle) * v));
      corners[i].normal = corners[i].position;
    }
    const double a = uniform(0.2, 0.5), b = uniform(0.2, 0.45);
    const glm::dvec3 at = a * corners[0].position + b * corners[1].position + (1 - a - b) * corners[2].position;
    const glm::dvec3 normal = glm::normalize(at), viewer = glm::normalize(normal + 0.7 * direction());
    const glm::dvec3 light = 2 * glm::dot(normal, viewer) * normal - viewer;
    source.light = source.light_at_point ? at + distance * light : light;
    source.viewer = source.viewer_at_point ? at + distance * viewer : viewer;
    return corners;
  }
};

// Radians between the normal and the halfway vector at the centre.
double off(const HighlightSource& source, const Corners& corners, const std::array<double, 3>& w) {
  glm::dvec3 p(0.0), n(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    p += w[i] * corners[i].position;
    n += w[i] * corners[i].normal;
  }
  const glm::dvec3 light = glm::normalize(source.light_at_point ? source.light - p : source.light);
  const glm::dvec3 viewer = glm::normalize(source.viewer_at_point ? source.viewer - p : source.viewer);
  const double sine = glm::length(glm::cross(glm::normalize(n), glm::normalize(light + viewer)));
  return std::asin(std::min(sine, 1.0));
}

TEST_F(HighlightSearchTest, RootsAreRoots) {
  for (int round = 0; round < 2000; ++round) {
    const double x = uniform(-2, 2), y = uniform(-2, 2), a = uniform(0.1, 3);
    const auto found = roots<double>(a, -a * (x + y), a * x * y);
    if (std::fabs(x - y) < 1e-6) continue;
    ASSERT_EQ(found.count, 2);
    EXPECT_NEAR(found.at[0], std::min(x, y), 1e-9);
    EXPECT_NEAR(found.at[1], std::max(x, y), 1e-9);
  }
  EXPECT_EQ(roots<double>(0, 0, 1).count, 0);
  EXPECT_EQ(roots<double>(0, 0, 0).count, 0);
  EXPECT_EQ(roots<double>(1, 0, 1).count, 0);
  EXPECT_EQ(roots<double>(1, 0, 0).at[0], 0.0);
  EXPECT_EQ(roots<double>(0, 2, -1).at[0], 0.5);
  // 1e8 would cancel in the printed formula.
  EXPECT_NEAR(roots<double>(1, -1e8, 1).at[0], 1e-8, 1e-20);
}

// Whatever is asked: roots that are given are roots, where the numbers hold them at all.
TEST_F(HighlightSearchTest, RootsOfHardQuadratics) {
  const double values[] = {0.0, -0.0, 1.0, -3.0, 1e-300, -1e-160, 1e-20, 1e20, -1e150, 1e300};
  for (const double a : values)
    for (const double b : values)
      for (const double c : values) {
        const auto found = roots<double>(a, b, c);
        ASSERT_LE(found.count, 2);
        EXPECT_FALSE(a == 0 && b == 0 && found.count > 0) << c;
        for (int i = 0; i < found.count; ++i) {
          const double x = found.at[static_cast<std::size_t>(i)];
          const double sizes = std::fabs(a * x * x) + std::fabs(b * x) + std::fabs(c);
          if (!std::isfinite(x) || !std::isfinite(sizes) || sizes < 1e-290 || b * b > 1e300 ||
              std::fabs(a * c) > 1e300 || (b * b < 1e-290 && std::fabs(a * c) < 1e-290))
            continue;
          EXPECT_LE(std::fabs(a * x * x + b * x + c), 1e-12 * sizes) << a << ' ' << b << ' ' << c << ": " << x;
        }
      }
}

// Corners, lights and normals at one place, on a line, or out of measure: no answer, or weights that add up to 1, or
// such as are no numbers, which Subdivision refuses.
TEST_F(HighlightSearchTest, HardTrianglesHaveANumberOrNone) {
  const glm::dvec3 places[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1e-60, 0, 0}, {1e60, -1e60, 3}};
  const glm::dvec3 normals[] = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0.3, 0.2, 1}, {1e-60, 0, 1e-60}};
  int answers = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto place = [&] { return places[random_() % std::size(places)]; };
    const auto normal = [&] { return normals[random_() % std::size(normals)]; };
    const HighlightSource source{random_() % 2 == 0, place(), random_() % 2 == 0, place()};
    const Corners corners{{{place(), normal()}, {place(), normal()}, {place(), normal()}}};
    const auto found = HighlightSearch<double>(source, corners).find(4);
    if (!found) continue;
    ++answers;
    const double sum = found->centre[0] + found->centre[1] + found->centre[2];
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
  EXPECT_GT(answers, 1000);
  EXPECT_LT(answers, 15000);
}

// Directions from infinitely far: H1 and H2 are lines, and the first estimate is the centre.
TEST_F(HighlightSearchTest, IsExactForDirectionsFromFar) {
  for (int round = 0; round < 2000; ++round) {
    HighlightSource source;
    const Corners corners = piece(0.3, source, 0.0);
    const auto found = HighlightSearch<double>(source, corners).find(0);
    ASSERT_TRUE(found.has_value());
    EXPECT_LT(off(source, corners, found->centre), 1e-9);
    EXPECT_NEAR(found->centre[0] + found->centre[1] + found->centre[2], 1.0, 1e-12);
  }
}

TEST_F(HighlightSearchTest, ComesNearerWithEveryTurn) {
  double first = 0.0, second = 0.0, last = 0.0;
  int found_all = 0;
  for (int round = 0; round < 2000; ++round) {
    HighlightSource source{true, {}, true, {}};
    const Corners corners = piece(0.3, source, uniform(1.5, 6.0));
    const HighlightSearch<double> search(source, corners);
    const auto rough = search.find(0), better = search.find(1), best = search.find(8);
    if (!rough) continue;
    ++found_all;
    first += off(source, corners, rough->centre);
    second += off(source, corners, better->centre);
    last += off(source, corners, best->centre);
  }
  EXPECT_GT(found_all, 1900);
  EXPECT_LT(second, 0.5 * first);
  EXPECT_LT(last, 0.01 * first);
  RecordProperty("mean_radians_first", std::to_string(first / found_all));
}

TEST_F(HighlightSearchTest, FindsTheCentreWhereLightAndViewerAreInOneDirection) {
  const Corners corners{{{{0, 0, 0}, {-0.3, -0.2, 1}}, {{1, 0, 0}, {0.5, -0.1, 1}}, {{0, 1, 0}, {0.0, 0.6, 1}}}};
  const HighlightSource source{false, {0, 0, 1}, false, {0, 0, 1}};
  const auto found = HighlightSearch<double>(source, corners).find(2);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(off(source, corners, found->centre), 1e-12);
}

TEST_F(HighlightSearchTest, HasNoAnswerWhereThereIsNone) {
  // All on one side of H1; no normals at all.
  const HighlightSource source{false, {1, 0, 1}, false, {-1, 0, 1}};
  const Corners beside{{{{0, 0, 0}, {0, 1, 1}}, {{1, 0, 0}, {0, 1, 2}}, {{0, 1, 0}, {0.1, 1, 1}}}};
  EXPECT_FALSE(HighlightSearch<double>(source, beside).find(2).has_value());
  const Corners none{{{{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {0, 0, 0}}, {{0, 1, 0}, {0, 0, 0}}}};
  EXPECT_FALSE(HighlightSearch<double>(source, none).find(2).has_value());
}

TEST_F(HighlightSearchTest, CountsWhatTheSamePlainNumbersGive) {
  HighlightSource source{true, {}, true, {}};
  const Corners corners = piece(0.2, source, 3.0);
  std::array<SurfacePoint<Number>, 3> counted;
  for (std::size_t i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      counted[i].position[c] = corners[i].position[c];
      counted[i].normal[c] = corners[i].normal[c];
    }
  const geometry::OperationCounts before = geometry::operation_counts;
  const auto found = HighlightSearch<Number>(source, counted).find(2);
  const geometry::OperationCounts took = geometry::operation_counts - before;
  const auto plain = HighlightSearch<double>(source, corners).find(2);
  ASSERT_TRUE(found && plain);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found->centre[i].value(), plain->centre[i]);
  EXPECT_GE(took.square_root, 2U + 4U * 2U);  // of two quadratics at least, and of four measures
}

}  // namespace
}  // namespace rastertlm::set_up::test
