// Is the largest step found where a whole edge meets its halves, and none elsewhere?
#include "modules/set_up/colour_steps.h"

#include <gtest/gtest.h>

#include <vector>

namespace rastertlm::set_up::test {
namespace {

ColourTriangle triangle(const std::array<geometry::SnappedPoint, 3>& corners, double t0, double t5 = 0.0) {
  ColourTriangle t;
  t.corners = corners;
  t.fraction_bits = 4;
  for (auto& form : t.colour) {
    form.t0 = t0;
    form.t5 = t5;
  }
  return t;
}

constexpr geometry::SnappedPoint kA{0, 0}, kMiddle{320, 0}, kB{640, 0}, kUp{320, -320}, kDown{320, 320};

TEST(ColourSteps, AreFoundAlongHalvesOfAnEdge) {
  // Below the edge one triangle of level 100; above it two of 103 and 95.
  const std::vector<ColourTriangle> triangles{triangle({kA, kB, kDown}, 100), triangle({kA, kUp, kMiddle}, 103),
                                              triangle({kMiddle, kUp, kB}, 95)};
  const ColourSteps steps = colour_steps(triangles);
  EXPECT_EQ(steps.edges, 1U);
  EXPECT_DOUBLE_EQ(steps.largest_levels, 5.0);
}

// x (x - 20) / 25 over the first half, 0 .. 20 pixels: 4 levels at its middle.
TEST(ColourSteps, AreLargestWhereTheDifferenceTurns) {
  ColourTriangle bent = triangle({kA, kUp, kMiddle}, 100, 1.0 / 25);
  for (auto& form : bent.colour) form.t2 = -20.0 / 25;
  const std::vector<ColourTriangle> triangles{triangle({kA, kB, kDown}, 100), bent, triangle({kMiddle, kUp, kB}, 100)};
  EXPECT_NEAR(colour_steps(triangles).largest_levels, 4.0, 1e-9);
}

TEST(ColourSteps, AreNoneAlongWholeEdges) {
  const std::vector<ColourTriangle> triangles{triangle({kA, kB, kDown}, 100), triangle({kA, kUp, kB}, 150)};
  const ColourSteps steps = colour_steps(triangles);
  EXPECT_EQ(steps.edges, 0U);
  EXPECT_EQ(steps.largest_levels, 0.0);
}

// Halves that are halved again.
TEST(ColourSteps, AreFoundAlongQuarters) {
  const geometry::SnappedPoint quarter{160, 0};
  const std::vector<ColourTriangle> triangles{triangle({kA, kB, kDown}, 100), triangle({kA, kUp, quarter}, 107),
                                              triangle({quarter, kUp, kMiddle}, 101), triangle({kMiddle, kUp, kB}, 99)};
  const ColourSteps steps = colour_steps(triangles);
  EXPECT_EQ(steps.edges, 1U);
  EXPECT_DOUBLE_EQ(steps.largest_levels, 7.0);
}

// At other places on both sides: every piece that two have in common is compared.
TEST(ColourSteps, AreFoundWhereBothSidesHaveOtherParts) {
  const geometry::SnappedPoint third{210, 0}, fifth{510, 0};
  const std::vector<ColourTriangle> triangles{triangle({kA, third, kDown}, 100), triangle({third, kB, kDown}, 90),
                                              triangle({kA, kUp, fifth}, 101), triangle({fifth, kUp, kB}, 86)};
  const ColourSteps steps = colour_steps(triangles);
  EXPECT_EQ(steps.edges, 2U);
  EXPECT_DOUBLE_EQ(steps.largest_levels, 11.0);
}

// The same line further on, and one beside it, are no part of the edge.
TEST(ColourSteps, AreNotOfOtherEdgesOnTheLine) {
  const geometry::SnappedPoint further{800, 0}, end{960, 0}, beside{0, 16}, beside_end{320, 16};
  EXPECT_EQ(colour_steps(std::vector<ColourTriangle>{triangle({kA, kB, kDown}, 100), triangle({kB, kUp, further}, 50),
                                                     triangle({further, end, kUp}, 20),
                                                     triangle({beside, beside_end, kUp}, 70)})
                .edges,
            0U);
}

// A surface that is seen behind the other has nothing to do with it.
TEST(ColourSteps, AreNotOfSurfacesBehindEachOther) {
  std::vector<ColourTriangle> triangles{triangle({kA, kB, kDown}, 100), triangle({kA, kUp, kMiddle}, 103)};
  EXPECT_EQ(colour_steps(triangles).edges, 1U);
  triangles[1].depth = {500.0, 500.0, 500.0};
  EXPECT_EQ(colour_steps(triangles).edges, 0U);
}

// Vertical lines run downwards.
TEST(ColourSteps, AreFoundAlongAVerticalEdge) {
  const geometry::SnappedPoint top{0, 0}, low{0, 640}, part_way{0, 111}, left{-300, 200}, right{300, 200};
  const ColourSteps steps = colour_steps(std::vector<ColourTriangle>{
      triangle({top, low, left}, 100), triangle({low, part_way, right}, 96), triangle({part_way, top, right}, 103)});
  EXPECT_EQ(steps.edges, 1U);
  EXPECT_DOUBLE_EQ(steps.largest_levels, 4.0);
}

}  // namespace
}  // namespace rastertlm::set_up::test
