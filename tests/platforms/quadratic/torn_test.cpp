// Are frames that change while they are shown handed on whole in number, in order, and as their screens show them?
#include <gtest/gtest.h>

#include <map>

#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

const std::string kQuadratic = RASTERTLM_SOURCE_DIR "/configs/machines/quadratic.toml";
const std::string kSphere = RASTERTLM_SOURCE_DIR "/configs/scenes/sphere_168.toml";

Simulated three_frames(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"video.columns=64", "video.lines=64", "span_unit.clock_ns=1500.0"});
  return simulation::unpacked(in_child([&] {
    const run::Inputs inputs = run::read_inputs(kQuadratic, kSphere, settings);
    std::vector<frame::Frame> shown;
    run::Options options;
    options.reference = false;
    options.frames = 3;
    const run::Result result =
        run::simulate(inputs, options, [&](const run::FramePixels& pixels) { shown.push_back(pixels.shown); });
    return simulation::packed(result, shown);
  }));
}

std::uint64_t torn_lines(const Simulated& simulated) {
  std::uint64_t lines = 0;
  for (const run::FrameFigures& frame : simulated.result.frames) lines += frame.span.torn_lines;
  return lines;
}

bool warns(const Simulated& simulated, const std::string& what) {
  for (const std::string& warning : simulated.result.warnings)
    if (warning.find(what) != std::string::npos) return true;
  return false;
}

// Of a scene that stands still one picture is as good as the next.
TEST(TornScreens, OfAStillSceneAndTwoBuffersAreWhole) {
  const Simulated whole = three_frames({});
  const Simulated swapped = three_frames({"frame_store.swap=completion"});
  ASSERT_EQ(whole.shown.size(), 3U);
  ASSERT_EQ(swapped.shown.size(), 3U);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(whole.shown[frame].rgb, swapped.shown[frame].rgb);
    EXPECT_EQ(whole.shown[frame].object, swapped.shown[frame].object);
    EXPECT_EQ(whole.shown[frame].coverage, swapped.shown[frame].coverage);
  }
  EXPECT_EQ(torn_lines(swapped), 0U);
  EXPECT_FALSE(warns(swapped, "torn"));
}

// One buffer, which is cleared and drawn while it is shown: parts are missing, and what observers see is missing with
// them. More frames are drawn than are handed on, because the last screen shows them.
TEST(TornScreens, OfOneBufferMissWhatIsNotDrawnYet) {
  const Simulated torn = three_frames({"frame_store.swap=completion", "frame_store.buffers=1"});
  const Simulated whole = three_frames({});
  ASSERT_EQ(torn.shown.size(), 3U);
  EXPECT_GT(torn.result.simulated_frames, 3U);
  EXPECT_GT(torn_lines(torn), 10U);
  EXPECT_TRUE(warns(torn, "torn"));
  for (std::size_t number = 0; number < 3; ++number) {
    EXPECT_EQ(torn.result.frames[number].frame, number);
    const frame::Frame& frame = torn.shown[number];
    std::uint64_t lines = 0;
    for (std::size_t line = 0; line < frame.lines; ++line) {
      bool same = true;
      for (std::size_t pixel = line * 64; pixel < (line + 1) * 64; ++pixel) {
        const bool seen = frame.rgb[3 * pixel] != 0;
        EXPECT_EQ(frame.object[pixel] != 0, seen);
        if (seen) {
          EXPECT_EQ(frame.rgb[3 * pixel], whole.shown[0].rgb[3 * pixel]);
        }
        same = same && frame.rgb[3 * pixel] == whole.shown[0].rgb[3 * pixel];
      }
      lines += same ? 0 : 1;
    }
    EXPECT_EQ(torn.result.frames[number].span.torn_lines, lines);
  }
}

// One buffer that waits for the screen is shown whole, in every second screen.
TEST(TornScreens, AreBetweenThoseOfOneBufferThatWaits) {
  const Simulated waits = three_frames({"frame_store.buffers=1"});
  EXPECT_EQ(torn_lines(waits), 0U);
  EXPECT_TRUE(warns(waits, "of 4 screens 2 show the one buffer while it is drawn"));
  EXPECT_EQ(waits.shown[0].rgb, three_frames({}).shown[0].rgb);
}

}  // namespace
}  // namespace rastertlm::test
