// Are triangles cut where those beside them have corners, there only, and lit there as they are themselves?
#include "modules/set_up/stitching.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <utility>

namespace rastertlm::set_up::test {
namespace {

class StitchingTest : public testing::Test {
 protected:
  StitchingTest() : lighting_(parameters(), {{glm::dvec3(0.05), glm::dvec3(0.4), glm::dvec3(0.5), 20}}, {}) {
    lighting_.set_lights({{false, glm::normalize(glm::dvec3(0.2, 0.1, 1)), glm::dvec3(1.0), glm::dvec3(1.0)}}, false);
    a_ = corner(0, 0, {-0.3, 0.1, 1});
    b_ = corner(640, 128, {0.4, 0.0, 0.9});
    above_ = corner(200, -400, {0.1, 0.5, 1});
    below_ = corner(320, 512, {0.0, -0.4, 1});
  }
  static SetUpParameters parameters() {
    SetUpParameters p;
    p.method = ShadingMethod::regular_subdivision;
    return p;
  }
  LitCorner corner(std::int64_t x, std::int64_t y, const glm::dvec3& normal) {
    LitCorner c;
    c.point.at = {x, y};
    c.point.normal = normal;
    c.depth = static_cast<double>(1000 + x + 2 * y);
    c.levels = lighting_.levels(c.point, 0);
    return c;
  }
  LitCorner between(const LitCorner& a, const LitCorner& b, double t) {
    LitCorner c;
    c.point = lighting_.inside({&a.point, &b.point, &b.point}, {1 - t, t, 0.0});
    c.point.at = {a.point.at.x + static_cast<std::int64_t>(t * static_cast<double>(b.point.at.x - a.point.at.x)),
                  a.point.at.y + static_cast<std::int64_t>(t * static_cast<double>(b.point.at.y - a.point.at.y))};
    c.depth = a.depth + t * (b.depth - a.depth);
    c.levels = lighting_.levels(c.point, 0);
    return c;
  }

  PointLighting lighting_;
  LitCorner a_, b_, above_, below_;
};

std::int64_t area(const LitTriangle& t) { return geometry::doubled_area(t[0].point.at, t[1].point.at, t[2].point.at); }

TEST_F(StitchingTest, ANeighbourGetsTheCornersOfTheCommonEdge) {
  const LitCorner quarter = between(a_, b_, 0.25), half = between(a_, b_, 0.5);
  Stitching stitching(lighting_);
  stitching.note({{a_, b_, above_}, {{a_, quarter, above_}, {quarter, half, above_}, {half, b_, above_}}, 0});
  CutTriangle below{{b_, a_, below_}, {{b_, a_, below_}}, 0};
  const std::uint64_t lights = lighting_.counts().evaluations;
  stitching.stitch(below);
  ASSERT_EQ(below.parts.size(), 3U);
  std::int64_t sum = 0;
  int shared = 0;
  for (const LitTriangle& part : below.parts) {
    EXPECT_GT(area(part) * area(below.whole), 0) << "turned over";
    sum += area(part);
    for (const LitCorner& c : part)
      for (const LitCorner& given : {quarter, half})
        if (c.point.at == given.point.at) {
          ++shared;
          EXPECT_EQ(c.levels, given.levels);
          EXPECT_EQ(c.depth, given.depth);
        }
  }
  EXPECT_EQ(sum, area(below.whole));
  EXPECT_EQ(shared, 4);
  EXPECT_EQ(lighting_.counts().evaluations, lights);
  EXPECT_EQ(stitching.counts().triangles, 1U);
  EXPECT_EQ(stitching.counts().corners, 2U);
}

// What lies on the line, but not on the edge; what touches in a corner; another frame's.
TEST_F(StitchingTest, OthersGetNone) {
  Stitching stitching(lighting_);
  const LitCorner half = between(a_, b_, 0.5);
  const CutTriangle cut{{a_, b_, above_}, {{a_, half, above_}, {half, b_, above_}}, 0};
  const LitCorner longer = corner(1280, 256, {0.5, 0.0, 0.9});
  const CutTriangle beside{{b_, a_, below_}, {{b_, a_, below_}}, 0};
  stitching.note(cut);
  for (CutTriangle other :
       {CutTriangle{{longer, b_, below_}, {{longer, b_, below_}}, 0},
        CutTriangle{{a_, below_, corner(-300, 20, {0, 0, 1})}, {{a_, below_, corner(-300, 20, {0, 0, 1})}}, 0}}) {
    stitching.stitch(other);
    EXPECT_EQ(other.parts.size(), 1U);
  }
  stitching.begin_frame();
  CutTriangle late = beside;
  stitching.stitch(late);
  EXPECT_EQ(late.parts.size(), 1U);
  EXPECT_EQ(stitching.counts().triangles, 0U);
}

// Across a crease the corner is the same and the light is not.
TEST_F(StitchingTest, AcrossACreaseACornerIsLitAnew) {
  Stitching stitching(lighting_);
  const LitCorner part_way = between(a_, b_, 0.375);
  stitching.note({{a_, b_, above_}, {{a_, part_way, above_}, {part_way, b_, above_}}, 0});
  const LitCorner a = corner(0, 0, {0.6, 0.2, 0.5}), b = corner(640, 128, {0.1, -0.7, 0.6});
  CutTriangle below{{b, a, below_}, {{b, a, below_}}, 0};
  stitching.stitch(below);
  ASSERT_EQ(below.parts.size(), 2U);
  const LitCorner own = between(a, b, 0.375);
  int shared = 0;
  for (const LitTriangle& part : below.parts)
    for (const LitCorner& c : part) {
      if (c.point.at != part_way.point.at) continue;
      ++shared;
      for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(c.levels[channel], own.levels[channel], 1e-9);
      EXPECT_GT(glm::length(c.levels - part_way.levels), 1.0);
    }
  EXPECT_EQ(shared, 2);
}

// Corners of parts on each other's edges, inside a triangle.
TEST_F(StitchingTest, PartsOfATriangleAreStitchedToEachOther) {
  Stitching stitching(lighting_);
  const LitCorner middle = between(between(a_, b_, 0.5), above_, 0.25), on_spoke = between(middle, above_, 0.5);
  CutTriangle cut{
      {a_, b_, above_}, {{a_, b_, middle}, {b_, above_, middle}, {a_, middle, on_spoke}, {a_, on_spoke, above_}}, 0};
  stitching.stitch(cut);
  ASSERT_EQ(cut.parts.size(), 5U);
  std::int64_t sum = 0;
  for (const LitTriangle& part : cut.parts) sum += area(part);
  EXPECT_EQ(sum, area(cut.whole));
}

}  // namespace
}  // namespace rastertlm::set_up::test
