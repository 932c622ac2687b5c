// Are the sums that vectors make those of a plain loop?
#include "src/reference/level_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "tests/src/reference/random_frames.h"

namespace rastertlm::reference {
namespace {

using testing_support::FramePair;
using testing_support::random_frames;

// Says the same in another way: a pixel at a time, with floor.
LevelComparison plain(const FramePair& pair, std::vector<std::size_t>& wrong_pixels) {
  LevelComparison result;
  for (std::size_t pixel = 0; pixel < pair.exact.pixels(); ++pixel) {
    const bool in_shown = pair.shown.object[pixel] != 0;
    const bool in_exact = pair.exact.object[pixel] != 0;
    if (!in_shown && !in_exact) continue;
    LevelSums& sums = result.regions[static_cast<std::size_t>(pair.exact.region[pixel])];
    int largest = 0;
    std::uint64_t squares = 0;
    double unrounded = 0.0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const int d = std::abs(pair.shown.rgb[i] - static_cast<int>(std::floor(pair.exact.rgb[i] + 0.5)));
      largest = std::max(largest, d);
      squares += static_cast<std::uint64_t>(d) * static_cast<std::uint64_t>(d);
      unrounded += std::pow(pair.shown.rgb[i] - pair.exact.rgb[i], 2.0);
    }
    if (in_shown != in_exact) {
      ++(in_shown ? sums.extra : sums.missing);
      sums.outline_squares += squares;
      continue;
    }
    ++sums.compared;
    sums.squares += squares;
    sums.unrounded_squares += unrounded;
    if (largest > 1) ++sums.over_one;
    if (largest > 2) ++sums.over_two;
    sums.largest = std::max(sums.largest, largest);
    if (pair.shown.object[pixel] == pair.exact.object[pixel]) {
      sums.largest_same_object = std::max(sums.largest_same_object, largest);
    } else {
      ++sums.wrong_object;
      wrong_pixels.push_back(pixel);
    }
  }
  return result;
}

constexpr double kOfItself = 7.0 / (1 << 24);  // level_sums.h

void expect_equal(const LevelSums& fast, const LevelSums& wanted) {
  EXPECT_EQ(fast.compared, wanted.compared);
  EXPECT_EQ(fast.missing, wanted.missing);
  EXPECT_EQ(fast.extra, wanted.extra);
  EXPECT_EQ(fast.wrong_object, wanted.wrong_object);
  EXPECT_EQ(fast.squares, wanted.squares);
  EXPECT_EQ(fast.outline_squares, wanted.outline_squares);
  EXPECT_EQ(fast.over_one, wanted.over_one);
  EXPECT_EQ(fast.over_two, wanted.over_two);
  EXPECT_EQ(fast.largest, wanted.largest);
  EXPECT_EQ(fast.largest_same_object, wanted.largest_same_object);
  EXPECT_NEAR(fast.unrounded_squares, wanted.unrounded_squares, kOfItself * wanted.unrounded_squares);
}

TEST(LevelSums, AreThoseOfAPlainLoop) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const std::size_t columns = 1 + seed * 7 % 90;
    const FramePair pair = random_frames(columns, 1 + seed % 13, seed);
    const LevelComparison fast = compare_frames(pair.shown, pair.exact);
    std::vector<std::size_t> wanted_pixels;
    const LevelComparison wanted = plain(pair, wanted_pixels);
    EXPECT_EQ(wrong_objects(pair.shown, pair.exact), wanted_pixels) << seed;
    for (std::size_t region = 0; region < frame::kRegions; ++region) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", region " << region);
      expect_equal(fast.regions[region], wanted.regions[region]);
    }
  }
}

// Sixteen pixels that are alike go another way than fifteen and one: the sum of what is not rounded has one order.
TEST(LevelSums, UnroundedSquaresDoNotDependOnTheWay) {
  FramePair pair = random_frames(160, 3, 5);
  for (std::size_t pixel = 0; pixel < pair.exact.pixels(); ++pixel) {
    pair.shown.object[pixel] = pair.exact.object[pixel] = 1;
    pair.exact.region[pixel] = frame::Region::inside;
  }
  const auto inside = static_cast<std::size_t>(frame::Region::inside);
  const double together = compare_frames(pair.shown, pair.exact).regions[inside].unrounded_squares;
  for (std::size_t pixel = 0; pixel < pair.exact.pixels(); pixel += 16)
    pair.shown.object[pixel] = pair.exact.object[pixel] = 2;
  EXPECT_EQ(compare_frames(pair.shown, pair.exact).regions[inside].unrounded_squares, together);
}

TEST(LevelSums, PicturesOfDifferentSizesAreRefused) {
  FramePair pair = random_frames(8, 2, 1);
  pair.exact.resize(2, 8);
  EXPECT_THROW(compare_frames(pair.shown, pair.exact), std::invalid_argument);
}

}  // namespace
}  // namespace rastertlm::reference
