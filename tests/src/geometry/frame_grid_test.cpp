// Which frames need the guard band, and does everything that is drawn lie within it?
#include "src/geometry/frame_grid.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace rastertlm::geometry {
namespace {

constexpr Viewport kScreen{512, 512};

SnapGrids grids() { return snap_grids(512, 512, 24, -1).value(); }

ScreenVertex<double> at(double x, double y) {
  ScreenVertex<double> v;
  v.x = x;
  v.y = y;
  return v;
}

// A clip vertex that lands on pixel position (x, y).
ClipVertex<double> clip_at(double x, double y, double z = 0.5) {
  ClipVertex<double> v;
  v.position = {(x + 0.5) / 256 - 1, 1 - (y + 0.5) / 256, z, 1};
  return v;
}

// Half a step of the grid outside is still snapped to the outermost sample on the left and above, where halves round
// towards the screen; on the right and below they round away from it.
TEST(FrameGrid, TheSnappedPositionDecides) {
  const SnapGrid grid = grids().on_screen;
  const double half_step = 1.0 / 64;
  EXPECT_TRUE(within_samples(at(0, 0), grid, kScreen));
  EXPECT_TRUE(within_samples(at(511, 511), grid, kScreen));
  EXPECT_TRUE(within_samples(at(-half_step, -half_step), grid, kScreen));
  EXPECT_FALSE(within_samples(at(-half_step - 1e-9, 5), grid, kScreen));
  EXPECT_FALSE(within_samples(at(5, -half_step - 1e-9), grid, kScreen));
  EXPECT_TRUE(within_samples(at(511 + half_step - 1e-9, 5), grid, kScreen));
  EXPECT_FALSE(within_samples(at(511 + half_step, 5), grid, kScreen));
  EXPECT_FALSE(within_samples(at(5, 511 + half_step), grid, kScreen));
}

TEST(FrameGrid, WhatIsNoNumberOrFarAwayIsNotWithin) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {nan, infinity, -infinity, 1e300, -1e300}) {
    EXPECT_FALSE(within_samples(at(x, 5), grids().on_screen, kScreen));
    EXPECT_FALSE(within_samples(at(5, x), grids().on_screen, kScreen));
    EXPECT_TRUE(needs_guard_band(clip_at(x, 5), grids().on_screen, kScreen));
    EXPECT_TRUE(needs_guard_band(clip_at(5, 5, x), grids().on_screen, kScreen));
  }
}

TEST(FrameGrid, NearAndFarBelongToTheVolume) {
  EXPECT_FALSE(needs_guard_band(clip_at(5, 5, 0.0), grids().on_screen, kScreen));
  EXPECT_FALSE(needs_guard_band(clip_at(5, 5, 1.0), grids().on_screen, kScreen));
  EXPECT_TRUE(needs_guard_band(clip_at(5, 5, -1e-9), grids().on_screen, kScreen));
  EXPECT_TRUE(needs_guard_band(clip_at(5, 5, 1.0 + 1e-9), grids().on_screen, kScreen));
}

TEST(FrameGrid, OneCornerDecidesAndSoDoesATriangleThatIsNotSeen) {
  const SnapGrid grid = grids().on_screen;
  EXPECT_FALSE(needs_guard_band(ClipTriangle<double>{clip_at(5, 5), clip_at(500, 5), clip_at(5, 500)}, grid, kScreen));
  EXPECT_TRUE(needs_guard_band(ClipTriangle<double>{clip_at(5, 5), clip_at(600, 5), clip_at(5, 500)}, grid, kScreen));
  EXPECT_TRUE(
      needs_guard_band(ClipTriangle<double>{clip_at(600, 5), clip_at(700, 5), clip_at(600, 500)}, grid, kScreen));
}

TEST(FrameGrid, AFrameOnTheFineGridIsNotClipped) {
  const ClipTriangle<double> triangle{clip_at(-1.0 / 64, 5), clip_at(500, 5), clip_at(5, 500)};
  const FrameGrid frame = frame_grid(grids(), false, kScreen);
  EXPECT_EQ(frame.grid.fraction_bits, 5);
  const Polygon<double> polygon = clip_to_frame(triangle, frame);
  ASSERT_EQ(polygon.size, 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(polygon.corners[i].position, triangle[i].position);
}

RC_GTEST_PROP(FrameGridProperty, EveryCornerOfAGuardedFrameSnapsIntoTheBand, ()) {
  const auto number = [](double range) {
    return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-1000000, 1000001)) * 1e-6 * range;
  };
  ClipTriangle<double> triangle;
  for (auto& vertex : triangle) vertex.position = {number(20), number(20), 1 + number(2), 1 + number(3)};
  const FrameGrid frame = frame_grid(grids(), true, kScreen);
  const Polygon<double> polygon = clip_to_frame(triangle, frame);
  const std::int64_t q = frame.grid.fraction_bits;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const SnappedPoint point = snap(to_screen(polygon.corners[i], kScreen), frame.grid.fraction_bits);
    RC_ASSERT(point.x >= -(255LL << q) && point.x <= (511LL + 255) << q);
    RC_ASSERT(point.y >= -(255LL << q) && point.y <= (511LL + 255) << q);
  }
}

}  // namespace
}  // namespace rastertlm::geometry
