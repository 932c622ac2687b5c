// Do the grids follow from the word width, and can no edge word wrap on the screen?
#include "src/geometry/snapping.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

namespace rastertlm::geometry {
namespace {

// The four limits of the edge equations: W^2 2^q < 2^23 with W = 511, 1021, 1023 and 2045.
TEST(SnapGrids, TwentyFourBitsAt512And1024) {
  const SnapGrids small = snap_grids(512, 512, 24, -1).value();
  EXPECT_EQ(small.on_screen.fraction_bits, 5);
  EXPECT_EQ(small.on_screen.guard_x, 0);
  EXPECT_EQ(small.guarded.fraction_bits, 3);
  EXPECT_EQ(small.guarded.guard_x, 255);
  EXPECT_EQ(small.guarded.guard_y, 255);
  const SnapGrids large = snap_grids(1024, 1024, 24, -1).value();
  EXPECT_EQ(large.on_screen.fraction_bits, 3);
  EXPECT_EQ(large.guarded.fraction_bits, 1);
  EXPECT_EQ(large.guarded.guard_x, 511);
}

// 639 * 479 = 306,081 and 2^23 / 306,081 = 27.4: four bits; 1277 * 957 = 1,222,089, 2^23 / that = 6.9: two bits.
TEST(SnapGrids, ScreensThatAreNotSquare) {
  const SnapGrids grids = snap_grids(640, 480, 24, -1).value();
  EXPECT_EQ(grids.on_screen.fraction_bits, 4);
  EXPECT_EQ(grids.guarded.fraction_bits, 2);
  EXPECT_EQ(grids.guarded.guard_x, 319);
  EXPECT_EQ(grids.guarded.guard_y, 239);
}

// 4095^2 = 16,769,025 lies between 2^23 and 2^24 - 2: 25 bits with the sign.
TEST(SnapGrids, ALargeScreenNeedsAWiderWord) {
  EXPECT_FALSE(snap_grids(4096, 4096, 24, -1).has_value());
  EXPECT_EQ(word_bits_needed(4096, 4096), 25);
  EXPECT_TRUE(snap_grids(4096, 4096, 25, -1).has_value());
  EXPECT_LE(word_bits_needed(512, 512), 24);
}

TEST(SnapGrids, TheLimitCapsBothGrids) {
  const SnapGrids grids = snap_grids(512, 512, 24, 2).value();
  EXPECT_EQ(grids.on_screen.fraction_bits, 2);
  EXPECT_EQ(grids.guarded.fraction_bits, 2);
  EXPECT_EQ(snap_grids(512, 512, 24, 4).value().guarded.fraction_bits, 3);
}

TEST(SnapGrids, WhereHalfAPixelDoesNotFitTheGuardBandShrinks) {
  const SnapGrids grids = snap_grids(2048, 2048, 24, -1).value();  // 2047^2 * 2 < 2^23, with no room for a band
  EXPECT_EQ(grids.on_screen.fraction_bits, 1);
  EXPECT_EQ(grids.guarded.fraction_bits, 1);
  EXPECT_GE(grids.guarded.guard_x, 0);
  EXPECT_LT(grids.guarded.guard_x, 2);
}

// Any of low..high at every size of the test case.
std::int64_t whole(std::int64_t low, std::int64_t high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

// An edge word: E(x, y) = A x + B y + C of the edge between two vertices of the box, at a corner of the screen, in
// units of 2^-q pixel.
std::int64_t edge(const SnappedPoint& a, const SnappedPoint& b, std::int64_t x, std::int64_t y, int q) {
  const std::int64_t scale = std::int64_t{1} << q;
  return floor_div((b.x - a.x) * (y * scale - a.y) - (b.y - a.y) * (x * scale - a.x), scale);
}

RC_GTEST_PROP(SnapGridsProperty, NoEdgeWordWrapsOnTheScreenAndNoFinerGridWouldDo, ()) {
  const auto columns = static_cast<std::size_t>(whole(1, 2000));
  const auto lines = static_cast<std::size_t>(whole(1, 2000));
  const int bits = static_cast<int>(whole(16, 33));
  const auto grids = snap_grids(columns, lines, bits, -1);
  const auto w = static_cast<std::int64_t>(columns) - 1;
  const auto h = static_cast<std::int64_t>(lines) - 1;
  const std::int64_t most = (std::int64_t{1} << (bits - 1)) - 1;
  if (!grids) {
    RC_ASSERT(w * h > most - 1);
    RC_ASSERT(word_bits_needed(columns, lines) > bits);
    return;
  }
  const int finest = grids->on_screen.fraction_bits;
  RC_ASSERT(finest == 12 || ((w * h) << (finest + 1)) > most - 1);
  for (const SnapGrid& grid : {grids->on_screen, grids->guarded}) {
    const int q = grid.fraction_bits;
    const auto vertex = [&] {
      const std::int64_t left = -grid.guard_x << q;
      const std::int64_t top = -grid.guard_y << q;
      // Corners of the box are the worst: taken half of the time.
      const auto pick = [](std::int64_t low, std::int64_t high) {
        const std::int64_t kind = whole(0, 3);
        return kind == 0 ? low : (kind == 1 ? high : whole(low, high));
      };
      return SnappedPoint{pick(left, (w + grid.guard_x) << q), pick(top, (h + grid.guard_y) << q)};
    };
    const SnappedPoint a = vertex();
    const SnappedPoint b = vertex();
    for (const std::int64_t x : {std::int64_t{0}, w})
      for (const std::int64_t y : {std::int64_t{0}, h}) {
        const std::int64_t e = edge(a, b, x, y, q);
        RC_ASSERT(e <= most);
        RC_ASSERT(e - 1 >= -most - 1);  // C is one unit less where the edge is not top-left
      }
  }
}

TEST(Snapping, RoundsHalfUpwards) {
  ScreenVertex<double> vertex;
  vertex.x = 1.0 + 1.0 / 64;
  vertex.y = -1.0 - 1.0 / 64;
  EXPECT_EQ(snap(vertex, 5), (SnappedPoint{33, -32}));
  vertex.x = 1.0 + 0.99 / 64;
  vertex.y = -1.0 - 1.01 / 64;
  EXPECT_EQ(snap(vertex, 5), (SnappedPoint{32, -33}));
}

// Up and to the right on the screen is counter-clockwise: a front face.
TEST(Snapping, CounterClockwiseFacesTheViewer) {
  const SnappedPoint a{0, 0};
  const SnappedPoint right{10, 0};
  const SnappedPoint up{0, -10};
  EXPECT_EQ(doubled_area(a, right, up), -100);
  EXPECT_TRUE(faces_viewer(doubled_area(a, right, up)));
  EXPECT_FALSE(faces_viewer(doubled_area(a, up, right)));
  EXPECT_FALSE(faces_viewer(doubled_area(a, right, {20, 0})));
}

// The volume's planes go through the samples at the end of the guard band.
TEST(ClipVolume, ItsPlanesAreWholePixelsFromTheOutermostSamples) {
  const Viewport viewport{640, 480};
  const SnapGrid grid{2, 319, 239};
  const ClipVolume volume = clip_volume(grid, viewport);
  ClipVertex<double> corner;
  corner.position = {volume.left, volume.top, 0.5, 1.0};
  EXPECT_NEAR(to_screen(corner, viewport).x, -319.0, 1e-10);
  EXPECT_NEAR(to_screen(corner, viewport).y, -239.0, 1e-10);
  corner.position = {volume.right, volume.bottom, 0.5, 1.0};
  EXPECT_NEAR(to_screen(corner, viewport).x, 639.0 + 319.0, 1e-10);
  EXPECT_NEAR(to_screen(corner, viewport).y, 479.0 + 239.0, 1e-10);
}

}  // namespace
}  // namespace rastertlm::geometry
