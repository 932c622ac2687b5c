// What do the tests at the corners find of the highlights that a search of every triangle finds?
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

struct Recall {
  std::uint64_t centres = 0;
  double found = 0.0;  // of them
};

Recall recall(const std::string& scene, std::vector<std::string> settings, std::uint64_t frames) {
  for (const char* setting :
       {"video.columns=64", "video.lines=64", "host.clock_hz=2000000000", "host.sustained_mflops=2000.0"})
    settings.emplace_back(setting);
  const std::string told = in_child([&] {
    const std::string configs = RASTERTLM_SOURCE_DIR "/configs/";
    run::Options options;
    options.frames = frames;
    std::ostringstream text;
    run::simulate(run::read_inputs(configs + "machines/adaptive.toml", configs + "scenes/" + scene, settings), options,
                  [&](const run::FramePixels& pixels) {
                    const run::HighlightFigures& h = pixels.figures.highlight;
                    text << h.true_centres << ' ' << h.recall.value_or(0.0) * static_cast<double>(h.true_centres)
                         << ' ';
                  });
    return text.str();
  });
  std::istringstream stream(told);
  Recall all;
  std::uint64_t centres = 0;
  for (double found = 0.0; stream >> centres >> found; all.found += found) all.centres += centres;
  return all;
}

// Infinitely far: whatever is cut into whatever triangles, nothing is missed.
TEST(Recall, IsOneForLightAndViewerInfinitelyFar) {
  for (const char* segments : {"1", "2", "4", "7"}) {
    const Recall far =
        recall("teapot.toml", {"set_up.attributes=linear", std::string("object[0].segments=") + segments}, 12);
    EXPECT_GT(far.centres, 5U);
    EXPECT_EQ(far.found, static_cast<double>(far.centres)) << segments;
  }
}

// A lamp nearer than the triangles are large: every highlight is missed. Further away, or with finer triangles, none.
TEST(Recall, IsNoneForALampNearerThanTheTrianglesAreLarge) {
  const Recall near = recall("lamp_at_sphere.toml", {}, 20);
  EXPECT_EQ(near.centres, 20U);
  EXPECT_EQ(near.found, 0.0);
  const Recall further = recall("lamp_at_sphere.toml", {"light[0].position=[2.85, -9.5, 1.9]"}, 20);
  EXPECT_EQ(further.centres, 20U);
  EXPECT_EQ(further.found, 20.0);
  const Recall finer = recall("lamp_at_sphere.toml", {"object[0].slices=96", "object[0].stacks=64"}, 20);
  EXPECT_EQ(finer.centres, 20U);
  EXPECT_EQ(finer.found, 20.0);
}

}  // namespace
}  // namespace rastertlm::test
