#include "src/scene/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>

#include "src/scene/newell_teapot.h"
#include "tests/src/scene/mesh_checks.h"

namespace rastertlm::scene {
namespace {

using namespace testing;

std::size_t equal_corners(const Mesh& mesh) {
  std::size_t count = 0;
  for (const auto& t : mesh.triangles) count += t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? 1U : 0U;
  return count;
}

TEST(Teapot, Has896TrianglesOf28PatchesAnd16WithoutArea) {
  const Mesh mesh = teapot(4, 28);
  EXPECT_EQ(mesh.triangles.size(), 896U);
  EXPECT_EQ(mesh.degenerate, 16U);
  EXPECT_EQ(equal_corners(mesh), 16U);
}

TEST(Teapot, Has1024TrianglesOf32Patches) {
  const Mesh mesh = teapot(4, 32);
  EXPECT_EQ(mesh.triangles.size(), 1024U);
  EXPECT_EQ(mesh.degenerate, 32U);  // the bottom has a pole as well
}

TEST(Teapot, AnyTessellationKeepsTheCounts) {
  for (const std::size_t n : {2U, 3U, 7U, 16U}) {
    const Mesh mesh = teapot(n, 28);
    EXPECT_EQ(mesh.triangles.size(), 28 * n * n * 2);
    EXPECT_EQ(mesh.degenerate, 4 * n);
    EXPECT_EQ(equal_corners(mesh), 4 * n);
  }
}

// The table itself: the pot is symmetric about the plane y = 0, patch by patch. (One copy in circulation breaks this in
// patch 11.)
TEST(Teapot, TableIsItsOwnMirrorImage) {
  std::multiset<std::set<Point>> patches;
  std::multiset<std::set<Point>> mirrored;
  for (const TeapotPatch& patch : kNewellTeapot) {
    std::set<Point> points;
    std::set<Point> images;
    for (const glm::dvec3& p : patch) {
      points.insert({p.x, p.y, p.z});
      images.insert({p.x, 0.0 - p.y, p.z});
    }
    patches.insert(points);
    mirrored.insert(images);
  }
  EXPECT_EQ(patches, mirrored);
}

// The open rims of the surface: rim and lid edges, the handle's two ends, the spout's two, and (28 patches) the body's
// foot.
TEST(Teapot, IsWatertightButForItsRims) {
  for (const std::size_t n :
       {2U, 4U, 5U, 9U, 11U})  // with one quad a patch, the halves of handle and spout fall together
  {
    const Seams open = seams(teapot(n, 28));
    EXPECT_EQ(open.repeated, 0U) << n;
    EXPECT_EQ(open.open, (4 + 4 + 4 + 4 + 4) * n) << n;
    const Seams closed = seams(teapot(n, 32));
    EXPECT_EQ(closed.repeated, 0U) << n;
    EXPECT_EQ(closed.open, (4 + 4 + 4 + 4) * n) << n;
  }
}

TEST(Teapot, NormalsAreUnitAndOutwards) {
  const Mesh mesh = teapot(16, 32);
  EXPECT_LT(worst_length_error(mesh), 1e-15 * 4);
  EXPECT_GT(worst_agreement(mesh), 0.5);
  EXPECT_GT(signed_volume(mesh), 0.0);
}

TEST(Teapot, PolesAreOneVertexWithAVerticalNormal) {
  const Mesh mesh = teapot(4, 32);
  std::map<double, int> poles;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 p = mesh.positions[i];
    if (p.x != 0.0 || p.y != 0.0 || (p.z != 3.15 && p.z != 0.0)) continue;
    ++poles[p.z];
    EXPECT_EQ(mesh.normals[i], glm::dvec3(0.0, 0.0, p.z == 0.0 ? -1.0 : 1.0));
  }
  EXPECT_EQ(poles, (std::map<double, int>{{0.0, 1}, {3.15, 1}}));
}

// Independent of the patches' derivatives: with finer quads a facet's normal tends to the surface's, its angle falling
// with the quad's size (1 - cosine: with its square).
TEST(Teapot, NormalsAreThoseOfTheSurface) {
  EXPECT_GT(worst_agreement(teapot(64, 32)), 0.97);
  EXPECT_GT(worst_agreement(teapot(128, 32)), 1.0 - 0.03 / 3.5);
}

TEST(Teapot, FillsItsKnownBox) {
  const Mesh mesh = teapot(8, 28);
  glm::dvec3 low(1e9);
  glm::dvec3 high(-1e9);
  for (const auto& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  EXPECT_NEAR(low.x, -3.0, 1e-12);  // handle
  EXPECT_NEAR(high.x, 3.43, 0.01);  // spout
  EXPECT_NEAR(low.z, 0.15, 1e-12);
  EXPECT_NEAR(high.z, 3.15, 1e-12);
  EXPECT_EQ(low.y, -high.y);
}

class Sphere : public ::testing::TestWithParam<std::array<std::size_t, 3>> {};

TEST_P(Sphere, IsClosedOrientedAndOnItsRadius) {
  const auto [slices, stacks, triangles] = GetParam();
  const Mesh mesh = uv_sphere(2.5, slices, stacks);
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_EQ(mesh.degenerate, 0U);
  const Seams s = seams(mesh);
  EXPECT_EQ(s.open, 0U);
  EXPECT_EQ(s.repeated, 0U);
  EXPECT_EQ(places(mesh), slices * (stacks - 1) + 2);
  EXPECT_EQ(places(mesh) + mesh.triangles.size(), s.edges + 2);  // Euler
  EXPECT_LT(worst_length_error(mesh), 1e-15);
  EXPECT_GT(worst_agreement(mesh), 0.0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_LT(glm::length(mesh.positions[i] - 2.5 * mesh.normals[i]), 1e-15);
  const double volume = 4.0 / 3.0 * std::numbers::pi * 2.5 * 2.5 * 2.5;
  EXPECT_GT(signed_volume(mesh), 0.2 * volume);
  EXPECT_LT(signed_volume(mesh), volume);
}

INSTANTIATE_TEST_SUITE_P(OfThePapers, Sphere,
                         ::testing::Values(std::array<std::size_t, 3>{12, 8, 168},
                                           std::array<std::size_t, 3>{17, 12, 374},
                                           std::array<std::size_t, 3>{23, 16, 690}, std::array<std::size_t, 3>{3, 2, 6},
                                           std::array<std::size_t, 3>{180, 89, 31680}));

TEST(Sphere, TendsToItsVolume) {
  EXPECT_NEAR(signed_volume(uv_sphere(1.0, 400, 200)), 4.0 / 3.0 * std::numbers::pi, 1e-3);
}

}  // namespace
}  // namespace rastertlm::scene
