// Are figures of two pictures those that are known of them?
#include "src/reference/picture_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/reference/colour.h"
#include "tests/src/reference/flip_pictures.h"

namespace rastertlm::reference {
namespace {

std::vector<std::uint8_t> bytes_of(const FlipPicture& picture) {
  return {picture.levels.begin(), picture.levels.end()};
}

// Three pixels that differ by one level, by two and by minus three, each in another channel.
TEST(PictureMetrics, SmallPictureByHand) {
  const std::vector<std::uint8_t> first{10, 20, 30, 40, 50, 60, 70, 80, 90, 0, 255, 7};
  const std::vector<std::uint8_t> second{11, 20, 30, 40, 52, 60, 70, 80, 87, 0, 255, 7};
  const LevelFigures f = compare_levels(first, second);
  EXPECT_EQ(f.max_level, 3.0);
  EXPECT_EQ(f.over_one_level_percent, 50.0);
  EXPECT_EQ(f.over_two_levels_percent, 25.0);
  EXPECT_DOUBLE_EQ(f.rmse_level, std::sqrt((1.0 + 4.0 + 9.0) / 12.0));
  ASSERT_TRUE(f.psnr_db.has_value());
  EXPECT_NEAR(*f.psnr_db, 10.0 * std::log10(255.0 * 255.0 * 12.0 / 14.0), 1e-12);
}

TEST(PictureMetrics, EqualPicturesHaveAnInfinitePsnr) {
  const FlipPicture noise = flip_noise(20, 10, 3, 255);
  EXPECT_FALSE(compare_levels(noise.levels, noise.levels).psnr_db.has_value());
  const PerceptualFigures seen = compare_as_seen(20, 10, noise.levels, noise.levels);
  EXPECT_EQ(seen.flip_mean + seen.flip_p95 + seen.ciede2000_mean + seen.ciede2000_p99, 0.0);
}

// Bytes and real levels go other ways.
TEST(PictureMetrics, BytesAndRealLevelsAgree) {
  for (const FlipPair& pair : flip_pairs(90, 70)) {
    const LevelFigures bytes = compare_levels(bytes_of(pair.reference), bytes_of(pair.test));
    const LevelFigures reals = compare_levels(pair.reference.levels, pair.test.levels);
    EXPECT_EQ(bytes.max_level, reals.max_level);
    EXPECT_EQ(bytes.rmse_level, reals.rmse_level);
    EXPECT_EQ(bytes.over_one_level_percent, reals.over_one_level_percent);
    EXPECT_EQ(bytes.over_two_levels_percent, reals.over_two_levels_percent);
  }
}

TEST(PictureMetrics, LargestDifferencesDoNotOverflow) {
  const std::vector<std::uint8_t> black(std::size_t{3} * 300 * 300, 0);
  const std::vector<std::uint8_t> white(black.size(), 255);
  const LevelFigures figures = compare_levels(black, white);
  EXPECT_EQ(figures.rmse_level, 255.0);
  EXPECT_EQ(figures.psnr_db, 0.0);
  EXPECT_EQ(figures.over_two_levels_percent, 100.0);
}

// A hundred pixels: 98 are equal, one differs as black and grey, one as black and white.
TEST(PictureMetrics, MeanAndPercentilesOfColours) {
  std::vector<double> first(300, 0.0);
  std::vector<double> second(300, 0.0);
  std::fill_n(second.begin() + 30, 3, 128.0);
  std::fill_n(second.begin() + 60, 3, 255.0);
  const double v = linear_light(128.0);
  const double grey = ciede2000({0, 0, 0}, lab_of_xyz(xyz_of_linear({v, v, v})));
  const PerceptualFigures figures = compare_as_seen(10, 10, first, second);
  EXPECT_NEAR(figures.ciede2000_mean, (grey + 100.0) / 100.0, 1e-9);
  EXPECT_NEAR(figures.ciede2000_p99, grey, 1e-9);
  EXPECT_EQ(figures.flip.size(), 100U);
  std::vector<double> sorted = figures.flip;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(figures.flip_p95, sorted[94]);
}

TEST(PictureMetrics, WhatIsNotDisplayedIsSeenAsTheNearestLevel) {
  const std::vector<double> beyond{-20.0, 300.0, 128.0};
  const std::vector<double> shown{0.0, 255.0, 128.0};
  const PerceptualFigures figures = compare_as_seen(1, 1, beyond, shown);
  EXPECT_EQ(figures.flip_mean + figures.ciede2000_mean, 0.0);
  EXPECT_EQ(compare_levels(beyond, shown).max_level, 45.0);
}

TEST(PictureMetrics, PercentileIsAValueThatIsThere) {
  EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 100.0), 3.0);
  EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 66.0), 2.0);
  EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 33.0), 1.0);
  EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 0.1), 1.0);
  EXPECT_THROW(percentile({}, 50.0), std::invalid_argument);
  EXPECT_THROW(percentile({1.0}, 0.0), std::invalid_argument);
}

TEST(PictureMetrics, DifferentSizesAreRefused) {
  const std::vector<double> one(3, 0.0);
  const std::vector<double> two(6, 0.0);
  EXPECT_THROW(compare_levels(one, two), std::invalid_argument);
  EXPECT_THROW(compare_levels(std::vector<double>{}, std::vector<double>{}), std::invalid_argument);
  EXPECT_THROW(compare_as_seen(1, 1, one, two), std::invalid_argument);
}

}  // namespace
}  // namespace rastertlm::reference
