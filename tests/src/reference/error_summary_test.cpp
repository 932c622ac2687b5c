// Are the worst and the mean of frames those of their figures?
#include "src/reference/error_summary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rastertlm::reference {
namespace {

ErrorFigures frame_with(std::uint64_t compared, double rmse) {
  ErrorFigures e;
  e.reference = "ideal";
  e.compared = compared;
  e.rmse_level = rmse;
  if (rmse > 0.0) e.psnr_db = 20 * std::log10(255.0 / rmse);
  e.max_level = static_cast<int>(std::ceil(rmse));
  return e;
}

ErrorSummary summary(const std::vector<ErrorFigures>& frames) {
  std::vector<const ErrorFigures*> pointers;
  for (const ErrorFigures& frame : frames) pointers.push_back(&frame);
  return summary_of(pointers);
}

// PSNR is of the mean square: (0 + 1 + 9) / 3.
TEST(ErrorSummary, WorstAndMeanByHand) {
  std::vector<ErrorFigures> frames{frame_with(10, 0.0), frame_with(20, 1.0), frame_with(30, 3.0)};
  frames[1].silhouettes.covered_missing = 4;
  frames[2].silhouettes.covered_missing = 2;
  frames[1].flicker_rms_level = 0.5;
  frames[2].flicker_rms_level = 0.25;
  const ErrorSummary s = summary(frames);
  EXPECT_EQ(s.reference, "ideal");
  EXPECT_EQ(s.frames, 3U);
  EXPECT_EQ(s.worst.reference, "ideal");
  EXPECT_EQ(s.worst.compared, 30U);
  EXPECT_EQ(s.worst.max_level, 3);
  EXPECT_EQ(s.worst.psnr_db, frames[2].psnr_db);
  EXPECT_EQ(s.worst.silhouettes.covered_missing, 4U);
  EXPECT_EQ(s.worst.flicker_rms_level, 0.5);
  EXPECT_DOUBLE_EQ(s.mean.compared.value(), 20.0);
  EXPECT_DOUBLE_EQ(s.mean.rmse_level.value(), 4.0 / 3);
  EXPECT_DOUBLE_EQ(s.mean.silhouettes.covered_missing.value(), 2.0);
  EXPECT_DOUBLE_EQ(s.mean.flicker_rms_level.value(), 0.375) << "the first frame has none";
  EXPECT_NEAR(s.mean.psnr_db.value(), 10 * std::log10(255.0 * 255 / (10.0 / 3)), 1e-10);
  EXPECT_FALSE(s.mean.flip_mean.has_value());
}

// Levels of nothing are no figures, and exact frames have no PSNR.
TEST(ErrorSummary, FramesWithoutAFigureDoNotCount) {
  std::vector<ErrorFigures> frames{frame_with(10, 2.0), frame_with(10, 2.0)};
  frames[1].highlights.compared = 5;
  frames[1].highlights.rmse_level = 1.5;
  const ErrorSummary s = summary(frames);
  EXPECT_EQ(s.mean.highlights.rmse_level, 1.5);
  EXPECT_EQ(s.mean.highlights.compared, 2.5);
  EXPECT_FALSE(s.mean.inside.rmse_level.has_value());
  const ErrorSummary exact = summary({frame_with(10, 0.0), frame_with(10, 0.0)});
  EXPECT_FALSE(exact.mean.psnr_db.has_value());
  EXPECT_EQ(exact.mean.rmse_level, 0.0);
}

TEST(ErrorSummary, OfOneFrameBothAreIt) {
  const ErrorSummary s = summary({frame_with(10, 2.5)});
  EXPECT_EQ(s.worst.rmse_level, 2.5);
  EXPECT_EQ(s.mean.rmse_level, 2.5);
  EXPECT_NEAR(s.mean.psnr_db.value(), s.worst.psnr_db.value(), 1e-12);
}

}  // namespace
}  // namespace rastertlm::reference
