// Which words does a load take to the span unit, and what are they on a bus? Worked by hand.
#include "modules/set_up/load_words.h"

#include <gtest/gtest.h>

#include "modules/set_up/span_load.h"

namespace rastertlm::set_up {
namespace {

using geometry::SnappedPoint;

LoadWords words(std::array<SnappedPoint, 3> corners, bool linear) {
  ColourTriangle t;
  t.fraction_bits = 4;
  t.corners = corners;
  return load_words(span_load(t, {}), linear);
}

// Level at the bottom: one half. Two halves: the left edge goes on, or the right one does.
constexpr std::array<SnappedPoint, 3> kOneHalf{{{160, 160}, {0, 480}, {320, 480}}};
constexpr std::array<SnappedPoint, 3> kLeftGoesOn{{{160, 160}, {0, 480}, {320, 320}}};
constexpr std::array<SnappedPoint, 3> kRightGoesOn{{{160, 160}, {0, 320}, {320, 480}}};
constexpr std::array<SnappedPoint, 3> kAbove{{{160, -480}, {0, -320}, {320, -160}}};

TEST(LoadWords, AreCountedByKind) {
  // The first line and how many; two edges of two columns and three rests; six registers a channel, three of depth.
  EXPECT_EQ(words(kOneHalf, false), (LoadWords{2, 4, 6, 18, 3}));
  EXPECT_EQ(words(kOneHalf, true), (LoadWords{2, 4, 6, 9, 3}));
  // How many lines more, and one edge.
  EXPECT_EQ(words(kLeftGoesOn, false), (LoadWords{3, 6, 9, 18, 3}));
  // And the registers anew, but for the second difference of a pixel and the slope of depth.
  EXPECT_EQ(words(kRightGoesOn, false), (LoadWords{3, 6, 9, 33, 5}));
  EXPECT_EQ(words(kRightGoesOn, true), (LoadWords{3, 6, 9, 15, 5}));
  EXPECT_EQ(words(kAbove, false), LoadWords{});
  EXPECT_EQ(words(kRightGoesOn, false).total(), 56U);
}

TEST(LoadWords, AreAsWideAsWhatTheyMustHold) {
  // 512 x 512: columns -512 .. 1024, an edge up to 1536 lines high. Its height in sixteenths, times 16: 393,216.
  const LoadWidths usual = load_widths(512, 512, 4, 32, 32);
  EXPECT_EQ(usual.lines, 10U);
  EXPECT_EQ(usual.columns, 12U);
  EXPECT_EQ(usual.rests, 19U);
  EXPECT_EQ(usual.colours, 32U);
  EXPECT_EQ(usual.depths, 32U);
  // Corners in 2^-14 pixel, of a grid of 2^-8 and six splits: 1536 x 2^28 is between 2^38 and 2^39.
  EXPECT_EQ(load_widths(512, 512, 14, 32, 32).rests, 39U);
  EXPECT_EQ(load_widths(511, 511, 0, 12, 20).lines, 9U);
}

// The largest that an edge of the size holds does fit, and twice as much would not.
TEST(LoadWords, HoldTheEdgesThatReachFarthest) {
  constexpr int kBits = 4;
  constexpr std::int64_t kOne = 1 << kBits;
  ColourTriangle t;
  t.fraction_bits = kBits;
  t.corners = {SnappedPoint{-512 * kOne, -512 * kOne}, SnappedPoint{-512 * kOne, 1024 * kOne},
               SnappedPoint{1024 * kOne, 1024 * kOne}};
  const span_unit::TriangleLoad load = span_load(t, {});
  const LoadWidths widths = load_widths(512, 512, kBits, 32, 32);
  ASSERT_EQ(load.count, 1U);
  for (const span_unit::EdgeWords& edge : {load.halves[0].start, load.halves[0].end}) {
    EXPECT_LT(edge.divisor, std::int64_t{1} << widths.rests);
    EXPECT_GE(edge.divisor, std::int64_t{1} << (widths.rests - 1));
    EXPECT_GE(edge.column, -(std::int64_t{1} << (widths.columns - 1)));
    EXPECT_LT(edge.column + edge.step * load.halves[0].lines, std::int64_t{1} << (widths.columns - 1));
  }
}

TEST(LoadWords, CrossTheBusByTheirWidths) {
  const LoadWords load = words(kOneHalf, false);
  const LoadWidths wide = load_widths(512, 512, 4, 32, 32);
  EXPECT_EQ(bus_words(load, wide, 32), 33U);
  // 16 bits: lines and columns whole, rests, colours and depths in two.
  EXPECT_EQ(bus_words(load, wide, 16), 2U + 4 + 2 * (6 + 18 + 3));
  // Colours of 12 bits cross whole, which makes depths of 32 and edges of 19 no narrower.
  EXPECT_EQ(bus_words(load, load_widths(512, 512, 4, 12, 32), 16), 2U + 4 + 2 * 6 + 18 + 2 * 3);
  // Rests of 39 bits take two words of 32, and three of 16.
  const LoadWidths fine = load_widths(512, 512, 14, 32, 32);
  EXPECT_EQ(bus_words(load, fine, 32), 2U + 4 + 2 * 6 + 18 + 3);
  EXPECT_EQ(bus_words(load, fine, 16), 2U + 4 + 3 * 6 + 2 * (18 + 3));
  EXPECT_EQ(bus_words(load, fine, 64), 33U);
}

}  // namespace
}  // namespace rastertlm::set_up
