// Does no method, in none of the paper's 60 views, show the background inside the outline, or anything outside it?
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "modules/host/set_up_work.h"
#include "src/reference/renderer.h"
#include "tests/platforms/adaptive/set_up_frames.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

constexpr std::size_t kSide = 96, kViews = 60;
// No surface has it: the teapot's red is never below its blue, and the lights are white.
constexpr std::array<std::uint8_t, 3> kBackground{0, 40, 255};

run::Inputs inputs_of(std::vector<std::string> settings) {
  for (const char* setting : {"video.columns=96", "video.lines=96", "host.clock_hz=2000000000",
                              "host.sustained_mflops=2000.0", "background=[0, 40, 255]"})
    settings.emplace_back(setting);
  return adaptive_inputs(settings);
}

// Of every view, a mark a pixel: whether any surface is seen there. Exact, given the corners' grid.
const std::vector<std::string>& outlines() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> views;
    const run::Inputs inputs = inputs_of({"set_up.method=gouraud"});
    const auto& machine = std::get<adaptive::Machine>(inputs.content->machine);
    const scene::Scene& scene = *inputs.content->scene;
    reference::RenderOptions options;
    options.kind = reference::Reference::snapped;
    options.lights_at_points = true;
    options.columns = options.lines = kSide;
    options.grids = host::span_grids(machine.viewport(), static_cast<int>(machine.set_up.snap_bits));
    for (std::size_t f = 0; f < kViews; ++f) {
      const frame::ExactFrame exact =
          reference::render(scene, scene::pose(scene, static_cast<std::int64_t>(f), kSide, kSide), options);
      std::string marks;
      for (const std::uint32_t object : exact.object) marks += object != 0 ? '#' : '.';
      views.push_back(marks);
    }
    return views;
  }();
  return all;
}

// The same of what the machine shows, by its colours.
std::string shown_outlines(const std::vector<std::string>& settings) {
  return in_child([&] {
    run::Options options;
    options.frames = kViews;
    options.reference = false;
    std::string marks;
    run::simulate(inputs_of(settings), options, [&](const run::FramePixels& pixels) {
      const std::vector<std::uint8_t>& rgb = pixels.shown.rgb;
      for (std::size_t i = 0; i < rgb.size(); i += 3)
        marks += std::equal(kBackground.begin(), kBackground.end(), rgb.begin() + static_cast<std::ptrdiff_t>(i)) ? '.'
                                                                                                                  : '#';
    });
    return marks;
  });
}

struct Drawn {
  const char* method;
  const char* stitch;
};

class Outline : public testing::TestWithParam<Drawn> {};

TEST_P(Outline, IsThatOfTheSnappedTrianglesInEveryView) {
  std::vector<std::string> settings{std::string("set_up.method=") + GetParam().method};
  if (std::string(GetParam().stitch) == "true") settings.emplace_back("subdivision.stitch=true");
  const std::string shown = shown_outlines(settings);
  constexpr std::size_t kPixels = kSide * kSide;
  ASSERT_EQ(shown.size(), kViews * kPixels);
  for (std::size_t f = 0; f < kViews; ++f) {
    const std::string view = shown.substr(f * kPixels, kPixels);
    EXPECT_TRUE(view == outlines()[f]) << "view " << f;
    EXPECT_GT(std::count(view.begin(), view.end(), '#'), 1000);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Outline,
                         testing::Values(Drawn{"gouraud", "false"}, Drawn{"regular_subdivision", "false"},
                                         Drawn{"regular_subdivision", "true"}, Drawn{"highlight_subdivision", "false"},
                                         Drawn{"highlight_subdivision", "true"}, Drawn{"pseudo_phong", "false"},
                                         Drawn{"gouraud_phong", "false"}, Drawn{"phong", "false"},
                                         Drawn{"duff", "false"}, Drawn{"taylor", "false"}, Drawn{"angular", "false"}),
                         [](const auto& one) {
                           return std::string(one.param.method) +
                                  (std::string(one.param.stitch) == "true" ? "Stitched" : "");
                         });

}  // namespace
}  // namespace rastertlm::test
