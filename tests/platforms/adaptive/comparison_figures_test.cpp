// The figures that methods are compared by: triangles in and out, light, operations and error. What must move them
// does.
#include <gtest/gtest.h>

#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

const std::string kAdaptive = RASTERTLM_SOURCE_DIR "/configs/machines/adaptive.toml";
const std::string kFourLights = RASTERTLM_SOURCE_DIR "/configs/scenes/teapot_four_lights.toml";

run::FrameFigures frame_of(const std::string& method, std::vector<std::string> settings = {}) {
  settings.push_back("set_up.method=" + method);
  settings.emplace_back("video.columns=128");
  settings.emplace_back("video.lines=128");
  return simulate(kAdaptive, kFourLights, {settings, 1, false, true, false}).result.frames.at(0);
}

// Whoever is interpolated is lit at points of triangles, whoever is not at its pixels; none at both.
TEST(ComparisonFigures, EveryPixelIsLitOnceOrItsTriangleIs) {
  const run::FrameFigures gouraud = frame_of("gouraud"), phong = frame_of("phong"), some = frame_of("gouraud_phong");
  EXPECT_EQ(gouraud.span.shaded_pixels, 0U);
  EXPECT_EQ(gouraud.span.shading_flops, 0U);
  EXPECT_EQ(gouraud.span.lighting_evaluations, 3 * gouraud.span.drawn_pieces);
  EXPECT_EQ(phong.span.shaded_pixels, phong.span.span_pixels);
  EXPECT_EQ(phong.span.shaded_pixels, phong.fragments);
  EXPECT_EQ(phong.span.lighting_evaluations, 0U);
  EXPECT_GT(some.span.shaded_pixels, 0U);
  EXPECT_LT(some.span.shaded_pixels, phong.span.shaded_pixels);
  EXPECT_GT(some.span.lighting_evaluations, 0U);
  EXPECT_LT(some.span.lighting_evaluations, gouraud.span.lighting_evaluations);
}

// A highlight's power is squared and multiplied: 31 takes four squares and four products, 32 five squares.
TEST(ComparisonFigures, APixelUnitsOperationsFollowMethodAndExponent) {
  const auto a_pixel = [](const run::FrameFigures& f) {
    return static_cast<double>(f.span.shading_flops) / static_cast<double>(f.span.shaded_pixels);
  };
  const double phong = a_pixel(frame_of("phong", {"material[0].exponent=32"}));
  EXPECT_GT(a_pixel(frame_of("phong", {"material[0].exponent=31"})), phong);
  EXPECT_LT(a_pixel(frame_of("angular", {"material[0].exponent=32"})), phong);
  EXPECT_LT(a_pixel(frame_of("taylor", {"material[0].exponent=32"})), phong);
  EXPECT_LT(a_pixel(frame_of("duff", {"material[0].exponent=32"})), phong);
}

// Triangles, light and operations grow as thresholds fall, and the error falls: in levels, in dB and in pixels.
TEST(ComparisonFigures, ThresholdsMoveThemAll) {
  const run::FrameFigures coarse = frame_of("regular_subdivision", {"subdivision.area_pixels=64.0"});
  const run::FrameFigures fine = frame_of("regular_subdivision", {"subdivision.area_pixels=4.0"});
  EXPECT_EQ(coarse.facing, fine.facing);
  EXPECT_LT(coarse.span.drawn_pieces, fine.span.drawn_pieces);
  EXPECT_LT(coarse.span.lighting_evaluations, fine.span.lighting_evaluations);
  EXPECT_LT(coarse.host_flops, fine.host_flops);
  const reference::ErrorFigures &large = error_of(coarse, "ideal"), &small = error_of(fine, "ideal");
  EXPECT_GT(large.rmse_level, small.rmse_level);
  EXPECT_LT(large.psnr_db.value(), small.psnr_db.value());
  EXPECT_GT(large.over_one_level_percent, small.over_one_level_percent);
}

// The exact picture is lit at every pixel: what is lit so too is off by rounding and at outlines, what is not, more.
TEST(ComparisonFigures, LightAtEveryPixelIsTheExactPicture) {
  const reference::ErrorFigures phong = error_of(frame_of("phong"), "ideal");
  const reference::ErrorFigures gouraud = error_of(frame_of("gouraud"), "ideal");
  EXPECT_GT(gouraud.rmse_level, 5.0 * phong.rmse_level);
  EXPECT_GT(gouraud.over_one_level_percent, 10.0 * phong.over_one_level_percent);
  EXPECT_LT(gouraud.psnr_db.value() + 14.0, phong.psnr_db.value());
  // What is left is the grid of the corners; and beside it, rounding.
  const reference::ErrorFigures fine = error_of(frame_of("phong", {"set_up.snap_bits=8"}), "ideal");
  EXPECT_LT(fine.rmse_level, 0.2);
  EXPECT_LT(fine.over_one_level_percent, 0.1);
}

}  // namespace
}  // namespace rastertlm::test
