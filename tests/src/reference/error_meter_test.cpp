// Are depth order, slopes at edges, flicker and what the eye sees measured as they are defined, and each where it is?
#include "src/reference/error_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/reference/metrics.h"
#include "src/reference/picture_metrics.h"
#include "tests/src/reference/random_frames.h"

namespace rastertlm::reference {
namespace {

using frame::Region;
using testing_support::FramePair;
using testing_support::random_frames;

// Everything covered by triangle 1 and inside, in both pictures the same level.
FramePair plain_pair(std::size_t columns, std::size_t lines, int level = 100) {
  FramePair pair;
  pair.shown.resize(columns, lines);
  pair.exact.resize(columns, lines);
  std::fill(pair.shown.object.begin(), pair.shown.object.end(), 1U);
  pair.exact.object = pair.shown.object;
  std::fill(pair.exact.region.begin(), pair.exact.region.end(), Region::inside);
  std::fill(pair.shown.rgb.begin(), pair.shown.rgb.end(), static_cast<std::uint8_t>(level));
  pair.exact.rgb.assign(std::vector<double>(pair.exact.rgb.size(), level));
  return pair;
}

void set_grey(FramePair& pair, std::size_t pixel, int shown, double exact) {
  for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
    pair.shown.rgb[i] = static_cast<std::uint8_t>(shown);
    pair.exact.rgb.set(i, exact);
  }
}

TEST(ErrorMeter, PartsAddUpToTheWhole) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const FramePair pair = random_frames(70, 9, seed);
    const ErrorFigures e = compare(pair.shown, pair.exact, "ideal");
    ErrorFigures elsewhere;  // of region "none", which no part holds
    for (std::size_t pixel = 0; pixel < pair.exact.pixels(); ++pixel) {
      if (pair.exact.region[pixel] != Region::none) continue;
      const bool shown = pair.shown.object[pixel] != 0, exact = pair.exact.object[pixel] != 0;
      elsewhere.compared += shown && exact ? 1 : 0;
      elsewhere.covered_missing += !shown && exact ? 1 : 0;
      elsewhere.covered_extra += shown && !exact ? 1 : 0;
    }
    const auto sum = [&](std::uint64_t RegionFigures::*figure) {
      return e.inside.*figure + e.silhouettes.*figure + e.highlights.*figure + elsewhere.*figure;
    };
    EXPECT_EQ(sum(&RegionFigures::compared), e.compared);
    EXPECT_EQ(sum(&RegionFigures::covered_missing), e.covered_missing);
    EXPECT_EQ(sum(&RegionFigures::covered_extra), e.covered_extra);
  }
}

// Three errors of a grey pixel: one level inside, two in a highlight, three at a silhouette.
TEST(ErrorMeter, EachErrorIsWhereItIs) {
  FramePair pair = plain_pair(32, 1);
  pair.exact.region[20] = Region::highlights;
  pair.exact.region[30] = Region::silhouettes;
  set_grey(pair, 3, 101, 100.2);
  set_grey(pair, 20, 102, 99.9);
  set_grey(pair, 30, 97, 100.0);
  const ErrorFigures e = compare(pair.shown, pair.exact, "ideal");
  EXPECT_EQ(e.inside.compared, 30U);
  EXPECT_EQ(e.inside.max_level, 1);
  EXPECT_DOUBLE_EQ(e.inside.rmse_level, std::sqrt(1.0 / 30));
  EXPECT_EQ(e.inside.over_one_level_percent, 0.0);
  EXPECT_EQ(e.highlights.max_level, 2);
  EXPECT_EQ(e.highlights.over_one_level_percent, 100.0);
  EXPECT_EQ(e.highlights.over_two_levels_percent, 0.0);
  EXPECT_EQ(e.silhouettes.max_level, 3);
  EXPECT_EQ(e.silhouettes.over_two_levels_percent, 100.0);
  EXPECT_NEAR(e.silhouettes.psnr_db.value(), 20 * std::log10(255.0 / 3), 1e-12);
  EXPECT_DOUBLE_EQ(e.rmse_level, std::sqrt((1.0 + 4 + 9) / 32));
  EXPECT_DOUBLE_EQ(e.over_two_levels_percent, 100.0 / 32);
}

// Depth 0.25 .. 0.26 is shown by words 1250 .. 1260; the bound is 5. Another triangle's word is right within 5 and the
// slope of a pixel, and wrong beyond, in front and behind.
TEST(ErrorMeter, DepthOrderIsWrongBeyondTheBoundOnly) {
  const DepthWords words{1000.0, 2000.0, 5.0};
  const auto wrong = [&](std::uint32_t word, bool same_triangle) {
    FramePair pair = plain_pair(9, 9);
    std::fill(pair.exact.depth.begin(), pair.exact.depth.end(), 0.25);
    pair.exact.depth[4 * 9 + 5] = 0.26;
    pair.shown.depth[4 * 9 + 4] = word;
    if (!same_triangle) pair.shown.object[4 * 9 + 4] = 7;
    pair.exact.region[4 * 9 + 4] = Region::silhouettes;
    const ErrorFigures e = ErrorMeter({"snapped", words}).measure(pair.shown, pair.exact);
    EXPECT_EQ(e.wrong_order, e.silhouettes.wrong_order);
    EXPECT_EQ(e.wrong_object, same_triangle ? 0U : 1U);
    return e.wrong_order;
  };
  EXPECT_EQ(wrong(1250, false), 0U);
  EXPECT_EQ(wrong(1275, false), 0U) << "1260 + 5 and as much again as depths there differ by, 10";
  EXPECT_EQ(wrong(1276, false), 1U);
  EXPECT_EQ(wrong(1235, false), 0U);
  EXPECT_EQ(wrong(1234, false), 1U);
  EXPECT_EQ(wrong(1900, true), 0U) << "that is an error of depth, not of order";
}

TEST(ErrorMeter, WithoutDepthWordsNoOrderIsWrong) {
  FramePair pair = plain_pair(3, 3);
  pair.shown.object[4] = 2;
  pair.shown.depth[4] = 77;
  EXPECT_EQ(ErrorMeter({"ideal"}).measure(pair.shown, pair.exact).wrong_order, 0U);
}

// Exact levels rise by 1 a pixel and then by 3, a jump of 2; displayed ones by 1 and 4, with a step between that counts
// for nothing: a jump of 3.
TEST(ErrorMeter, EdgesCountByTheJumpOfTheSlope) {
  FramePair pair = plain_pair(4, 1);
  pair.exact.object = pair.shown.object = {1, 1, 2, 2};
  pair.exact.edges[1] = frame::kEdgeToTheRight;
  const double exact[] = {10, 11, 12, 15};
  const int shown[] = {10, 11, 20, 24};
  for (std::size_t i = 0; i < 4; ++i) set_grey(pair, i, shown[i], exact[i]);
  const ErrorFigures e = compare(pair.shown, pair.exact, "ideal");
  EXPECT_EQ(e.edges_measured, 1U);
  EXPECT_EQ(e.edge_jump_rms_level, 1.0);
  EXPECT_EQ(e.edge_jump_max_level, 1.0);
  EXPECT_EQ(e.inside.edges_measured, 1U);
  EXPECT_FALSE(e.highlights.edge_jump_rms_level.has_value());
  pair.shown.object[2] = 3;  // an edge that moved is not measured
  EXPECT_EQ(compare(pair.shown, pair.exact, "ideal").edges_measured, 0U);
}

// An error that is linear over the picture has no jump at any edge, in lines or columns; one triangle that is a level
// too bright has none either, and one that gets brighter by two levels a pixel has two.
TEST(ErrorMeter, OnlyTheSlopeOfErrorsCounts) {
  FramePair pair = plain_pair(8, 8);
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      const std::size_t pixel = 8 * y + x;
      pair.exact.object[pixel] = pair.shown.object[pixel] = y < 4 ? 1 : 2;
      pair.exact.edges[pixel] = y == 3 ? frame::kEdgeBelow : std::uint8_t{0};
      set_grey(pair, pixel, static_cast<int>(100 + 2 * x + 3 * y), 100);
    }
  EXPECT_EQ(compare(pair.shown, pair.exact, "ideal").edges_measured, 8U);
  EXPECT_EQ(compare(pair.shown, pair.exact, "ideal").edge_jump_max_level, 0.0);
  for (std::size_t pixel = 32; pixel < 64; ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      pair.shown.rgb[3 * pixel + c] = static_cast<std::uint8_t>(pair.shown.rgb[3 * pixel + c] + 1);
  EXPECT_EQ(compare(pair.shown, pair.exact, "ideal").edge_jump_max_level, 0.0);
  for (std::size_t pixel = 32; pixel < 64; ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      pair.shown.rgb[3 * pixel + c] = static_cast<std::uint8_t>(pair.shown.rgb[3 * pixel + c] + 2 * (pixel / 8));
  EXPECT_EQ(compare(pair.shown, pair.exact, "ideal").edge_jump_rms_level, 2.0);
}

// Pixel 0 stands still and its error goes from 1 to -2; pixel 1 moves by one level, and so does what is shown; pixel 2
// moves by two; pixel 3 was not covered before.
TEST(ErrorMeter, FlickerIsTheChangeOfTheErrorWhereNothingMoves) {
  FramePair pair = plain_pair(4, 1);
  set_grey(pair, 0, 101, 100);
  pair.shown.object[3] = 0;
  ErrorMeter meter({"ideal"});
  const ErrorFigures first = meter.measure(pair.shown, pair.exact);
  EXPECT_EQ(first.still_pixels, 0U);
  EXPECT_FALSE(first.flicker_rms_level.has_value());
  set_grey(pair, 0, 98, 100);
  set_grey(pair, 1, 101, 101);
  set_grey(pair, 2, 150, 102);
  pair.shown.object[3] = 1;
  const ErrorFigures second = meter.measure(pair.shown, pair.exact);
  EXPECT_EQ(second.still_pixels, 2U);
  EXPECT_EQ(second.flicker_max_level, 3.0);
  EXPECT_DOUBLE_EQ(second.flicker_rms_level.value(), 3.0 / std::sqrt(2.0));
  EXPECT_EQ(second.inside.still_pixels, 2U);
  EXPECT_EQ(meter.measure(pair.shown, pair.exact).flicker_max_level, 0.0);
}

// As two pictures of levels, of which the exact one is rounded; parts are of their pixels.
TEST(ErrorMeter, WhatTheEyeSeesIsOfRoundedPictures) {
  const FramePair pair = random_frames(40, 30, 11);
  const ErrorFigures e = ErrorMeter({"ideal", {}, 30.0}).measure(pair.shown, pair.exact);
  std::vector<double> exact;
  for (const double level : pair.exact.rgb) exact.push_back(std::floor(level + 0.5));
  const std::vector<double> shown(pair.shown.rgb.begin(), pair.shown.rgb.end());
  const PerceptualFigures seen = compare_as_seen(40, 30, exact, shown, 30.0);
  EXPECT_EQ(e.flip_mean, seen.flip_mean);
  EXPECT_EQ(e.flip_p95, seen.flip_p95);
  EXPECT_EQ(e.ciede2000_mean, seen.ciede2000_mean);
  EXPECT_EQ(e.ciede2000_p99, seen.ciede2000_p99);
  double sum = 0.0;
  double pixels = 0.0;
  for (std::size_t pixel = 0; pixel < seen.flip.size(); ++pixel) {
    if (pair.exact.region[pixel] != Region::highlights) continue;
    sum += seen.flip[pixel];
    pixels += 1.0;
  }
  EXPECT_NEAR(e.highlights.flip_mean.value(), sum / pixels, 1e-12);
  EXPECT_FALSE(compare(pair.shown, pair.exact, "ideal").flip_mean.has_value());
}

}  // namespace
}  // namespace rastertlm::reference
