// Are the error figures those of pictures whose errors are known?
#include "src/reference/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace rastertlm::reference {
namespace {

constexpr double kUnrounded = 3.5 / (1 << 24);  // of itself: half of what its squares may be off (level_sums.h)

// A screen of four pixels in a line. Shown: nothing is covered; exact: likewise.
struct Pictures {
  frame::Frame shown;
  frame::ExactFrame exact;
  Pictures() {
    shown.resize(4, 1);
    exact.resize(4, 1);
  }
  void set(std::size_t pixel, std::uint32_t object, std::uint32_t exact_object, int level, double exact_level) {
    shown.object[pixel] = object;
    exact.object[pixel] = exact_object;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      shown.rgb[i] = static_cast<std::uint8_t>(level);
      exact.rgb.set(i, exact_level);
    }
  }
};

TEST(Metrics, EqualPicturesHaveNoErrorAndAnInfinitePsnr) {
  Pictures p;
  p.set(0, 1, 1, 100, 100.49);
  p.set(1, 2, 2, 101, 100.5);
  const ErrorFigures figures = compare(p.shown, p.exact, "ideal");
  EXPECT_EQ(figures.reference, "ideal");
  EXPECT_EQ(figures.compared, 2U);
  EXPECT_EQ(figures.covered_missing + figures.covered_extra + figures.wrong_object, 0U);
  EXPECT_EQ(figures.max_level, 0);
  EXPECT_EQ(figures.rmse_level, 0.0);
  EXPECT_FALSE(figures.psnr_db.has_value());
  EXPECT_EQ(figures.over_one_level_percent, 0.0);
  EXPECT_NEAR(figures.rmse_unrounded_level, std::sqrt((0.49 * 0.49 + 0.5 * 0.5) / 2), kUnrounded * 0.5);
}

TEST(Metrics, CoverageIsCountedAndNotCompared) {
  Pictures p;
  p.set(0, 1, 0, 255, 0);
  p.set(1, 0, 1, 0, 255);
  p.set(2, 0, 3, 0, 255);
  const ErrorFigures figures = compare(p.shown, p.exact, "true");
  EXPECT_EQ(figures.covered_extra, 1U);
  EXPECT_EQ(figures.covered_missing, 2U);
  EXPECT_EQ(figures.compared, 0U);
  EXPECT_EQ(figures.max_level, 0);
  EXPECT_EQ(figures.rmse_level, 0.0);
}

// A missing pixel shows the background, 0, where 100 should be, and counts with the outline: (3 x 100^2) over the 6
// channels of two pixels.
TEST(Metrics, MissingPixelsCountWithTheOutline) {
  Pictures p;
  p.set(0, 1, 1, 50, 50.0);
  p.set(1, 0, 2, 0, 100.0);
  const ErrorFigures figures = compare(p.shown, p.exact, "ideal");
  EXPECT_EQ(figures.covered_missing, 1U);
  EXPECT_FALSE(figures.psnr_db.has_value());
  EXPECT_NEAR(figures.psnr_outline_db.value(), 20 * std::log10(255.0 / std::sqrt(30000.0 / 6)), 1e-10);
}

// Differences of one pixel's channels 3, 0, 4 (same object); of another's 10, 10, 10 (wrong object); of two others 1
// and 0. Mean square = (9 + 16 + 300 + 3) / 12 = 328 / 12; two pixels of four differ by more than one level.
TEST(Metrics, LevelsByHand) {
  Pictures p;
  p.set(0, 1, 1, 50, 50.0);
  p.shown.rgb[0] = 53;
  p.shown.rgb[2] = 46;
  p.set(1, 1, 2, 90, 100.0);
  p.set(2, 3, 3, 101, 100.4);
  p.set(3, 3, 3, 7, 7.0);
  const ErrorFigures figures = compare(p.shown, p.exact, "ideal");
  EXPECT_EQ(figures.compared, 4U);
  EXPECT_EQ(figures.wrong_object, 1U);
  EXPECT_EQ(figures.max_level, 10);
  EXPECT_EQ(figures.max_level_same_object, 4);
  EXPECT_NEAR(figures.rmse_level, std::sqrt(328.0 / 12), 1e-12);
  EXPECT_NEAR(figures.psnr_db.value(), 20 * std::log10(255.0 / std::sqrt(328.0 / 12)), 1e-10);
  EXPECT_NEAR(figures.over_one_level_percent, 50.0, 1e-12);
  const double unrounded = std::sqrt((9 + 16 + 300 + 3 * 0.36) / 12);
  EXPECT_NEAR(figures.rmse_unrounded_level, unrounded, kUnrounded * unrounded);
}

TEST(Metrics, PicturesOfDifferentSizesAreRefused) {
  Pictures p;
  p.exact.resize(2, 2);
  EXPECT_THROW(compare(p.shown, p.exact, "ideal"), std::invalid_argument);
}

// Depth 0.5 between the words 100 and 300 is 200.
TEST(Metrics, DepthInUnitsOfTheWord) {
  Pictures p;
  p.set(0, 1, 1, 0, 0);
  p.exact.depth[0] = 0.5;
  p.shown.depth[0] = 203;
  p.set(1, 1, 2, 0, 0);  // another triangle: not compared
  p.shown.depth[1] = 9999;
  EXPECT_NEAR(largest_depth_error(p.shown, p.exact, 100, 300), 3.0, 1e-12);
}

}  // namespace
}  // namespace rastertlm::reference
