// Does clipping keep what is inside, and do neighbours get the same vertices?
#include "src/geometry/clipping.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "src/geometry/frame_grid.h"

namespace rastertlm::geometry {
namespace {

using Vertex = ClipVertex<double>;

// The whole range at any size of the test case: small cases are not simpler here.
double between(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low * 4096, high * 4096 + 1)) / 4096.0;
}
double number(int range) { return between(-range, range); }

Vertex any_vertex() {
  Vertex v;
  v.position = {number(5), number(5), between(-1, 3), between(-1, 4)};
  v.position += glm::dvec4(1.7e-5, 2.9e-5, 5.3e-5, 7.1e-5);  // on no plane: such a corner would be there twice
  v.normal = {number(1), number(1), number(1)};
  return v;
}

bool same_bits(const Vertex& a, const Vertex& b) { return a.position == b.position && a.normal == b.normal; }

constexpr unsigned kAllPlanes = (1U << kClipPlanes) - 1;
constexpr ClipVolume kGuard{-1.75, 1.875, -1.5, 1.625};

RC_GTEST_PROP(ClippingProperty, AnIntersectionIsTheSameFromBothSides, ()) {
  const Vertex a = any_vertex();
  const Vertex b = any_vertex();
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    if ((plane_distance(a.position, plane, kGuard) < 0) == (plane_distance(b.position, plane, kGuard) < 0)) continue;
    const Vertex v = intersection(a, b, plane, kGuard);
    RC_ASSERT(same_bits(v, intersection(b, a, plane, kGuard)));
    RC_ASSERT(std::abs(plane_distance(v.position, plane, kGuard)) < 1e-12);
  }
}

// Corners of the polygon on the line through a and b.
std::vector<Vertex> corners_on_edge(const Polygon<double>& polygon, const Vertex& a, const Vertex& b) {
  std::vector<Vertex> found;
  const glm::dvec4 along = glm::normalize(b.position - a.position);
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const glm::dvec4 from_a = polygon.corners[i].position - a.position;
    if (glm::length(from_a - glm::dot(from_a, along) * along) < 1e-9) found.push_back(polygon.corners[i]);
  }
  std::sort(found.begin(), found.end(),
            [](const Vertex& p, const Vertex& q) { return canonically_before(p.position, q.position); });
  return found;
}

RC_GTEST_PROP(ClippingProperty, NeighboursGetTheSameVerticesOnTheirEdge, ()) {
  const Vertex a = any_vertex();
  const Vertex b = any_vertex();
  const Vertex c = any_vertex();
  const Vertex d = any_vertex();
  RC_PRE(glm::length(b.position - a.position) > 0.1);
  const auto apart = [&](const Vertex& p) {  // from the edge, or it would not be clear which corners are on it
    const glm::dvec4 along = glm::normalize(b.position - a.position);
    const glm::dvec4 from_a = p.position - a.position;
    return glm::length(from_a - glm::dot(from_a, along) * along) > 0.01;
  };
  RC_PRE(apart(c) && apart(d));
  const auto first = corners_on_edge(clip<double>({a, b, c}, kAllPlanes, kGuard), a, b);
  const auto second = corners_on_edge(clip<double>({b, a, d}, kAllPlanes, kGuard), a, b);
  RC_TAG(first.size());
  RC_ASSERT(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) RC_ASSERT(same_bits(first[i], second[i]));
}

// What of a triangle is seen at (x, y) in normalised device coordinates: the point of its cone with w = 1, by Cramer's
// rule. Corners may lie behind the eye. No clipping, no division by a corner's w.
struct Hit {
  glm::dvec3 weights;
  double z = 0.0;
};

bool solve(const std::array<Vertex, 3>& triangle, double x, double y, Hit& hit) {
  glm::dmat3 m;
  for (int i = 0; i < 3; ++i)
    m[i] = {triangle[static_cast<std::size_t>(i)].position.x, triangle[static_cast<std::size_t>(i)].position.y,
            triangle[static_cast<std::size_t>(i)].position.w};
  if (std::abs(glm::determinant(m)) < 1e-3) return false;
  hit.weights = glm::inverse(m) * glm::dvec3(x, y, 1.0);
  hit.z = 0.0;
  for (std::size_t i = 0; i < 3; ++i) hit.z += hit.weights[static_cast<int>(i)] * triangle[i].position.z;
  return true;
}

// Distance from the decision: positive inside.
double margin(const Hit& hit) { return std::min({hit.weights.x, hit.weights.y, hit.weights.z, hit.z, 1.0 - hit.z}); }

RC_GTEST_PROP(ClippingProperty, WhatIsSeenInsideTheVolumeStays, ()) {
  const std::array<Vertex, 3> triangle{any_vertex(), any_vertex(), any_vertex()};
  const Polygon<double> polygon = clip(triangle, kAllPlanes, kGuard);
  RC_ASSERT(polygon.size == 0 || (polygon.size >= 3 && polygon.size <= kMaxPolygonCorners));
  for (std::size_t i = 0; i < polygon.size; ++i)
    for (int plane = 0; plane < kClipPlanes; ++plane)
      RC_ASSERT(plane_distance(polygon.corners[i].position, plane, kGuard) > -1e-11);
  for (int sample = 0; sample < 20; ++sample) {
    const double x = number(1);
    const double y = number(1);
    Hit whole;
    if (!solve(triangle, x, y, whole) || std::abs(margin(whole)) < 1e-6) continue;
    int pieces = 0;
    bool unclear = false;
    for (std::size_t k = 1; k + 1 < polygon.size; ++k) {
      Hit part;
      if (!solve({polygon.corners[0], polygon.corners[k], polygon.corners[k + 1]}, x, y, part)) {
        unclear = true;
        continue;
      }
      const double inside = std::min({part.weights.x, part.weights.y, part.weights.z});
      if (std::abs(inside) < 1e-6) unclear = true;
      if (inside <= 0.0) continue;
      ++pieces;
      RC_ASSERT(std::abs(part.z - whole.z) < 1e-6);
    }
    if (!unclear) RC_ASSERT(pieces == (margin(whole) > 0.0 ? 1 : 0));
  }
}

TEST(Clipping, ATriangleInsideIsUntouched) {
  std::array<Vertex, 3> triangle{};
  triangle[0].position = {0, 0, 0.5, 1};
  triangle[1].position = {1, 0, 0.0, 1};
  triangle[2].position = {0, 1, 1.0, 1};
  const Polygon<double> polygon = clip(triangle, kAllPlanes, kGuard);
  ASSERT_EQ(polygon.size, 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(polygon.corners[i], triangle[i]));
}

TEST(Clipping, ATriangleOutsideOnePlaneIsGone) {
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    const glm::dvec4 outside[] = {{0, 0, -1, 1},  {0, 0, 2, 1},   {-3, 0, 0.5, 1},
                                  {3, 0, 0.5, 1}, {0, 3, 0.5, 1}, {0, -3, 0.5, 1}};
    std::array<Vertex, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i].position = outside[plane] + glm::dvec4(i == 1 ? 0.1 : 0.0, i == 2 ? 0.1 : 0.0, 0, 0);
    EXPECT_EQ(outcode(triangle[0].position, kGuard), 1U << plane);
    EXPECT_EQ(clip(triangle, kAllPlanes, kGuard).size, 0U);
  }
}

// By hand: the corner (0, 0, -1, 1) with neighbours at z = 1 is cut at the middle of its edges.
TEST(Clipping, TheNearPlaneByHand) {
  std::array<Vertex, 3> triangle{};
  triangle[0].position = {0, 0, -1, 1};
  triangle[1].position = {1, 0, 1, 1};
  triangle[2].position = {0, 1, 1, 1};
  triangle[0].normal = {0, 0, 1};
  triangle[1].normal = {1, 0, 0};
  triangle[2].normal = {0, 1, 0};
  const Polygon<double> polygon = clip(triangle, 1U, kGuard);
  ASSERT_EQ(polygon.size, 4U);
  EXPECT_EQ(polygon.corners[0].position, glm::dvec4(0.5, 0, 0, 1));
  EXPECT_EQ(polygon.corners[0].normal, glm::dvec3(0.5, 0, 0.5));
  EXPECT_TRUE(same_bits(polygon.corners[1], triangle[1]));
  EXPECT_TRUE(same_bits(polygon.corners[2], triangle[2]));
  EXPECT_EQ(polygon.corners[3].position, glm::dvec4(0, 0.5, 0, 1));
}

}  // namespace
}  // namespace rastertlm::geometry
