// Does the adaptive machine show what 003 saw of its methods, and does no method open a crack?
#include <gtest/gtest.h>

#include <map>

#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

const std::string kAdaptive = RASTERTLM_SOURCE_DIR "/configs/machines/adaptive.toml";
const std::string kTeapot = RASTERTLM_SOURCE_DIR "/configs/scenes/teapot_four_lights.toml";

struct Views {
  std::vector<run::FrameFigures> figures;
  std::vector<std::vector<std::uint32_t>> covered;  // by which triangle, from 1
};

// Of a quick host, frame after frame.
Views views(const std::string& method, int side, std::uint64_t frames, std::vector<std::string> settings = {}) {
  const std::string size = std::to_string(side);
  settings.push_back(std::string("set_up.method=").append(method));
  settings.push_back(std::string("video.columns=").append(size));
  settings.push_back(std::string("video.lines=").append(size));
  for (const char* setting :
       {"host.clock_hz=2000000000", "host.sustained_mflops=2000.0", "object[0].animation[0].deg_per_frame=37.0"})
    settings.emplace_back(setting);
  const std::string packed = in_child([&] {
    const run::Inputs inputs = run::read_inputs(kAdaptive, kTeapot, settings);
    run::Options options;
    options.frames = frames;
    options.reference = false;
    std::string bytes;
    run::simulate(inputs, options, [&](const run::FramePixels& pixels) {
      const run::HighlightFigures& h = pixels.figures.highlight;
      for (const std::uint64_t count : {h.tested, h.potentially, h.neighbours, h.divided, h.parts, h.unfound,
                                        pixels.figures.span.lighting_evaluations, pixels.figures.host_flops})
        bytes += std::to_string(count) + ' ';
      for (const std::uint32_t object : pixels.shown.object) bytes += std::to_string(object) + ' ';
    });
    return bytes;
  });
  Views all;
  std::istringstream stream(packed);
  for (std::uint64_t f = 0; f < frames; ++f) {
    run::FrameFigures& figures = all.figures.emplace_back();
    run::HighlightFigures& h = figures.highlight;
    stream >> h.tested >> h.potentially >> h.neighbours >> h.divided >> h.parts >> h.unfound >>
        figures.span.lighting_evaluations >> figures.host_flops;
    all.covered.emplace_back(static_cast<std::size_t>(side * side));
    for (std::uint32_t& object : all.covered.back()) stream >> object;
  }
  EXPECT_TRUE(stream.good());
  return all;
}

// What every method covers, Gouraud covers, in every view: where parts meet, and where they meet what is not cut, no
// pixel of the background shows.
TEST(Adaptive, NoMethodOpensACrack) {
  constexpr std::uint64_t kViews = 5;
  const Views whole = views("gouraud", 200, kViews);
  for (const char* method : {"regular_subdivision", "highlight_subdivision", "gouraud_phong", "phong", "duff", "taylor",
                             "angular", "pseudo_phong"}) {
    const Views cut = views(method, 200, kViews);
    for (std::size_t f = 0; f < kViews; ++f) {
      std::size_t differs = 0;
      for (std::size_t i = 0; i < whole.covered[f].size(); ++i)
        differs += (whole.covered[f][i] == 0) != (cut.covered[f][i] == 0) ? 1 : 0;
      EXPECT_EQ(differs, 0U) << method << ", frame " << f;
    }
  }
}

// 003, table 2 and section 4: regular subdivision adjusts itself to the picture's size, highlight subdivision depends
// on light alone; neighbours are four times as many.
TEST(Adaptive, RegularPartsGrowWithThePictureAndHighlightPartsDoNot) {
  constexpr std::uint64_t kViews = 4;
  const Views small = views("regular_subdivision", 256, kViews), large = views("regular_subdivision", 512, kViews);
  const Views small_highlights = views("highlight_subdivision", 256, kViews),
              large_highlights = views("highlight_subdivision", 512, kViews);
  for (std::size_t f = 0; f < kViews; ++f) {
    const auto of = [f](const Views& v) -> const run::HighlightFigures& { return v.figures[f].highlight; };
    EXPECT_EQ(of(small).tested, 896U);
    EXPECT_EQ(of(small).potentially, of(large).potentially);
    EXPECT_GT(of(small).potentially, 40U);
    EXPECT_LT(of(small).potentially, 200U);
    EXPECT_GT(of(small).neighbours, of(small).potentially);
    EXPECT_GT(of(large).parts, 2 * of(small).parts);
    // The grid of the screen may turn over or drop what is hardly a pixel.
    EXPECT_NEAR(static_cast<double>(of(small_highlights).parts), static_cast<double>(of(large_highlights).parts),
                0.02 * static_cast<double>(of(large_highlights).parts));
    EXPECT_EQ(of(large_highlights).unfound, 0U);
  }
}

// Recall against a search of every triangle: of the paper's kind of scene nothing is missed; what is only near is
// looked at too.
TEST(Adaptive, FindsTheTrueCentresAndMore) {
  const std::string told = in_child([] {
    std::vector<std::string> small;
    for (const char* setting : {"video.columns=64", "video.lines=64"}) small.emplace_back(setting);
    const run::Inputs inputs = run::read_inputs(kAdaptive, kTeapot, small);
    run::Options options;
    std::string text;
    run::simulate(inputs, options, [&](const run::FramePixels& pixels) {
      const run::HighlightFigures& h = pixels.figures.highlight;
      std::ostringstream figures;
      figures << h.true_centres << ' ' << h.recall.value() << ' ' << h.precision.value();
      text = figures.str();
    });
    return text;
  });
  std::istringstream stream(told);
  std::uint64_t centres = 0;
  double recall = 0.0, precision = 0.0;
  stream >> centres >> recall >> precision;
  EXPECT_GT(centres, 10U);
  EXPECT_EQ(recall, 1.0);
  EXPECT_GT(precision, 0.1);
  EXPECT_LT(precision, 0.9);
}

// More rings, more parts; a larger threshold, fewer.
TEST(Adaptive, ThresholdsAndRingsMoveTheParts) {
  const auto parts = [](const std::string& method, const std::string& setting) {
    return views(method, 256, 1, {setting}).figures[0].highlight.parts;
  };
  EXPECT_LT(parts("regular_subdivision", "highlight_test.rings=0"),
            parts("regular_subdivision", "highlight_test.rings=1"));
  EXPECT_LT(parts("regular_subdivision", "highlight_test.rings=1"),
            parts("regular_subdivision", "highlight_test.rings=3"));
  EXPECT_LT(parts("regular_subdivision", "subdivision.area_pixels=128.0"),
            parts("regular_subdivision", "subdivision.area_pixels=8.0"));
  EXPECT_LT(parts("highlight_subdivision", "subdivision.intensity_error=1.0"),
            parts("highlight_subdivision", "subdivision.intensity_error=0.05"));
}

}  // namespace
}  // namespace rastertlm::test
