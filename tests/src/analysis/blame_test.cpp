// Is each wrong pixel of a whole machine explained? With no step exact the frame is the machine's, with all exact it is
// the ideal picture, both to the last bit at every pixel; what is between belongs to the step that was spoilt.
#include "src/analysis/blame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "src/analysis/blame_machines.h"

namespace rastertlm::analysis {
namespace {

struct Case {
  const char* name;
  const char* machine;
  const char* scene;
  std::vector<std::string> set = {};
  std::uint64_t frames = 1;
};

run::Inputs inputs_of(const Case& c) {
  const std::string configs = std::string(RASTERTLM_SOURCE_DIR) + "/configs/";
  return run::read_inputs(configs + "machines/" + c.machine + ".toml", configs + "scenes/" + c.scene + ".toml", c.set);
}

// One simulation a process: each test makes one.
void show(const Case& c, const std::function<void(const run::Inputs&, const run::FramePixels&)>& look) {
  const run::Inputs inputs = inputs_of(c);
  run::Options options;
  options.frames = c.frames;
  run::simulate(inputs, options, [&](const run::FramePixels& pixels) { look(inputs, pixels); });
}

FrameBlame blamed(const Case& c) {
  FrameBlame last;
  show(c, [&](const run::Inputs& inputs, const run::FramePixels& pixels) { last = blame(inputs, pixels); });
  return last;
}

const report::StepFigures& of(const FrameBlame& blame, Step step) {
  const auto& steps = blame.figures.steps;
  return *std::find_if(steps.begin(), steps.end(),
                       [&](const report::StepFigures& f) { return f.step == traits_of(step).name; });
}

// For the name of the test: without, it would have the bytes of pointers.
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class BlameEnds : public testing::TestWithParam<Case> {};

TEST_P(BlameEnds, NoneExactIsTheMachineAndAllAreTheIdealPicture) {
  std::uint64_t looked_at = 0;
  show(GetParam(), [&](const run::Inputs& inputs, const run::FramePixels& pixels) {
    const auto frames = explained_frames(inputs, pixels);
    StepSet all;
    for (const Step step : frames.front()->steps()) all = all.with(step);
    std::uint64_t not_shown = 0, not_ideal = 0, not_this_pose = 0;
    const frame::Frame& shown = pixels.shown;
    for (std::size_t y = 0; y < shown.lines; ++y)
      for (std::size_t x = 0; x < shown.columns; ++x) {
        const std::size_t pixel = y * shown.columns + x;
        ExplainedFrame& frame = *frames[y % frames.size()];
        not_this_pose += frame.look_at(x, y) == Step::other_words ? 1 : 0;
        const std::uint8_t* levels = &shown.rgb[3 * pixel];
        const double* ideal = &pixels.ideal->rgb[3 * pixel];
        not_shown += frame.levels(StepSet()) != glm::dvec3(levels[0], levels[1], levels[2]) ? 1 : 0;
        not_ideal += frame.levels(all) != glm::dvec3(ideal[0], ideal[1], ideal[2]) ? 1 : 0;
        looked_at += shown.object[pixel] != 0 ? 1 : 0;
      }
    EXPECT_EQ(not_this_pose, 0U);
    EXPECT_EQ(not_shown, 0U);
    EXPECT_EQ(not_ideal, 0U);
  });
  EXPECT_GT(looked_at, 1000U);
}

const std::vector<Case> kCases{
    {"Imogene", "imogene", "teapot"},
    {"ImogeneLiteral", "imogene", "teapot", {"shading.arithmetic=\"literal\""}},
    {"ImogeneScaledEdges", "imogene", "teapot", {"object_processor.edges=\"scaled\""}},
    {"ImogeneNarrowWords", "imogene", "teapot", {"object_processor.word_bits=20", "object_processor.normal_bits=9"}},
    {"ImogeneClipped", "imogene", "teapot_orbit", {"camera.eye=[0.0, -3.0, 3.0]", "host.processors_per_unit=256"}},
    {"ImogeneColoured", "imogene", "teapot", {"light[0].intensity=[1.0, 0.5, 0.25]", "shading.specular_tables=3"}},
    {"ImogeneOrthographic", "imogene", "sphere_690", {"lighting.model=\"blinn\"", "lighting.specular_gate=false"}},
    {"ImogeneInterlaced", "imogene_1024_interlaced", "teapot"},
    {"Quadratic", "quadratic", "sphere_168"},
    {"QuadraticTeapot", "quadratic", "teapot_at_rest"},
    {"QuadraticSpans", "quadratic", "sphere_374", {"span_unit.units=4"}},
    {"QuadraticTriangles", "quadratic", "sphere_374", {"span_unit.units=2", "span_unit.share=\"triangles\""}},
    {"QuadraticPublished", "quadratic", "sphere_168", {"span_unit.start_edge=\"published\""}},
    {"QuadraticPrestep", "quadratic", "sphere_168", {"span_unit.start_edge=\"prestep\""}},
    {"QuadraticAdaptive", "quadratic", "sphere_168", {"set_up.method=\"quadratic_adaptive\""}},
    {"QuadraticGouraud", "quadratic", "sphere_168", {"set_up.method=\"gouraud\""}},
    {"QuadraticPseudoPhong", "quadratic", "sphere_168", {"set_up.method=\"pseudo_phong\""}},
    {"QuadraticSingle", "quadratic", "sphere_168", {"set_up.arithmetic=\"float\""}},
    {"QuadraticPerspective", "quadratic", "teapot_at_rest", {"set_up.attributes=\"perspective\""}},
    {"AdaptiveDefault", "adaptive", "sphere_374"},
    {"AdaptiveLamp", "adaptive", "lamp_at_sphere", {"set_up.method=\"highlight_subdivision\""}},
    {"AdaptiveGouraudPhong", "adaptive", "sphere_168", {"set_up.method=\"gouraud_phong\""}},
    {"AdaptivePhong", "adaptive", "sphere_168", {"set_up.method=\"phong\""}},
    {"AdaptiveDuff", "adaptive", "sphere_168", {"set_up.method=\"duff\""}},
    {"AdaptiveTaylor", "adaptive", "sphere_168", {"set_up.method=\"taylor\""}},
    {"AdaptiveAngular", "adaptive", "sphere_168", {"set_up.method=\"angular\""}},
};

INSTANTIATE_TEST_SUITE_P(Machines, BlameEnds, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

// Every wrong pixel is blamed on something, once, and no right one is.
TEST(Blame, PixelsAddUp) {
  show({"", "imogene", "teapot"}, [](const run::Inputs& inputs, const run::FramePixels& pixels) {
    const FrameBlame blame = analysis::blame(inputs, pixels);
    const report::FrameBlameFigures& f = blame.figures;
    std::uint64_t wrong = 0, pixel = 0;
    for (const std::uint32_t step : blame.step) {
      bool differs = false;
      for (std::size_t c = 0; c < 3; ++c)
        differs = differs || pixels.shown.rgb[3 * pixel + c] !=
                                 static_cast<int>(std::floor(pixels.ideal->rgb[3 * pixel + c] + 0.5));
      const bool covered = pixels.shown.object[pixel] != 0 || pixels.ideal->object[pixel] != 0;
      EXPECT_EQ(step != 0, differs && covered) << "pixel " << pixel;
      wrong += step != 0 ? 1 : 0;
      ++pixel;
    }
    EXPECT_EQ(f.wrong, wrong);
    std::uint64_t blamed = f.other_words;
    double of_largest = 0.0;
    for (const report::StepFigures& s : f.steps) {
      blamed += s.blamed_pixels;
      of_largest += s.of_largest_level;
      EXPECT_NEAR(s.interaction_share, s.removed_share - s.alone_share, 1e-12);
    }
    EXPECT_EQ(blamed, f.wrong);
    EXPECT_NEAR(of_largest, f.largest_level, 1e-9);
    EXPECT_EQ(f.other_words, 0U);
    const reference::ErrorFigures& error = pixels.figures.errors.front();
    EXPECT_EQ(error.reference, "ideal");
    EXPECT_EQ(f.pixels, error.compared + error.covered_missing + error.covered_extra);
    EXPECT_GT(of(blame, Step::coverage).blamed_pixels, 0U) << "snapped outlines";
  });
}

// Objects that have no processor are not in the picture: no step of a pixel made them so.
TEST(Blame, ObjectsWithoutAProcessorAreToldApart) {
  const FrameBlame blame = blamed({"", "imogene", "teapot", {"host.overflow=\"drop\"", "host.processors_per_unit=80"}});
  EXPECT_GT(blame.figures.other_words, 1000U);
  EXPECT_EQ(std::count(blame.step.begin(), blame.step.end(), static_cast<std::uint32_t>(Step::other_words)),
            static_cast<std::ptrdiff_t>(blame.figures.other_words));
}

TEST(Blame, PublishedStartEdgeIsBlamed) {
  const FrameBlame blame = blamed({"", "quadratic", "sphere_690", {"span_unit.start_edge=\"published\""}});
  EXPECT_GT(of(blame, Step::start_edge).alone_max_level, 1.0);
  EXPECT_GT(of(blame, Step::start_edge).blamed_pixels, 0U);
}

TEST(Blame, LatticeStartEdgeIsNot) {
  const FrameBlame blame = blamed({"", "quadratic", "sphere_690"});
  EXPECT_LT(of(blame, Step::start_edge).alone_max_level, 1e-3) << "but for what wide words round";
  EXPECT_LT(of(blame, Step::set_up_solver).alone_max_level, 1e-6) << "double";
  EXPECT_GT(of(blame, Step::interpolation).alone_share, 0.5);
}

TEST(Blame, FewFractionBitsAreBlamed) {
  const FrameBlame blame =
      blamed({"", "quadratic", "sphere_690", {"span_unit.fraction_bits=6", "span_unit.word_bits=16"}});
  EXPECT_GT(of(blame, Step::coefficients).alone_share, of(blame, Step::interpolation).alone_share);
}

// A teapot's lid and body come near each other: 12 bits do not tell them apart everywhere.
TEST(Blame, FewDepthBitsAreBlamed) {
  const FrameBlame blame = blamed({"", "quadratic", "teapot_at_rest", {"span_unit.depth_bits=12"}});
  EXPECT_GT(of(blame, Step::depth_order).blamed_pixels, 10U);
  EXPECT_GT(of(blame, Step::depth_order).alone_share, 0.0);
}

TEST(Blame, EnoughDepthBitsAreNot) {
  EXPECT_EQ(of(blamed({"", "quadratic", "teapot_at_rest"}), Step::depth_order).blamed_pixels, 0U);
}

TEST(Blame, ShortNormalsAreBlamed) {
  const FrameBlame blame = blamed({"", "imogene", "teapot", {"object_processor.normal_bits=7"}});
  const auto& steps = blame.figures.steps;
  const auto most = std::max_element(steps.begin(), steps.end(),
                                     [](const auto& a, const auto& b) { return a.blamed_pixels < b.blamed_pixels; });
  EXPECT_EQ(most->step, traits_of(Step::pre_normalisation).name);
}

}  // namespace
}  // namespace rastertlm::analysis
