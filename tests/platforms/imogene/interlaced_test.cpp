// Are the two fields of an interlaced picture those that a screen which is not interlaced would show at the same times,
// and do rates, cycles and errors mean what they say?
#include <algorithm>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

constexpr std::size_t kColumns = 96;
constexpr std::size_t kLines = 80;

// A frame that is not interlaced takes as long as a field: round(1 / (50 Hz x 60 ns)) clocks.
class InterlacedTest : public SimulationTest {
 protected:
  Simulated shown(bool interlaced, std::uint64_t frames, std::vector<std::string> set = {},
                  const std::string& scene = scene_of(std::string(kSphere) + kSpin)) const {
    set.insert(set.end(), {"video.columns=96", "video.lines=80"});
    if (interlaced) set.emplace_back("video.interlaced=true");
    return show(scene, {.set = set, .frames = frames});
  }
};

template <class T>
void expect_lines(const std::vector<T>& woven, const std::vector<T>& field, std::size_t values, std::size_t parity) {
  const auto width = static_cast<std::ptrdiff_t>(values * kColumns);
  for (std::size_t line = parity; line < kLines; line += 2) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(line) * width;
    EXPECT_TRUE(std::equal(woven.begin() + at, woven.begin() + at + width, field.begin() + at)) << "line " << line;
  }
}

void expect_field(const frame::Frame& woven, const frame::Frame& field, std::size_t parity) {
  expect_lines(woven.rgb, field.rgb, 3, parity);
  expect_lines(woven.depth, field.depth, 1, parity);
  expect_lines(woven.normal, field.normal, 3, parity);
  expect_lines(woven.object, field.object, 1, parity);
  expect_lines(woven.material, field.material, 1, parity);
  expect_lines(woven.coverage, field.coverage, 1, parity);
}

TEST_F(InterlacedTest, WeavesThePicturesOfTwoPoses) {
  const Simulated woven = shown(true, 3);
  const Simulated fields = shown(false, 6);
  ASSERT_EQ(woven.shown.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(woven.result.frames[k].animation_frame, static_cast<std::int64_t>(2 * k));
    EXPECT_EQ(woven.result.frames[k].last_animation_frame, static_cast<std::int64_t>(2 * k + 1));
    expect_field(woven.shown[k], fields.shown[2 * k], 0);
    expect_field(woven.shown[k], fields.shown[2 * k + 1], 1);
    EXPECT_EQ(woven.result.frames[k].words_sent,
              fields.result.frames[2 * k].words_sent + fields.result.frames[2 * k + 1].words_sent);
    EXPECT_EQ(woven.result.frames[k].host_flops,
              fields.result.frames[2 * k].host_flops + fields.result.frames[2 * k + 1].host_flops);
    EXPECT_NE(woven.shown[k].rgb, fields.shown[2 * k].rgb) << "it moves";
  }
  expect_exact(woven, 4);  // the exact pictures are woven too
}

TEST_F(InterlacedTest, ModellingEverythingChangesNothing) {
  const RunOptions usual{.set = {"video.columns=96", "video.lines=80", "video.interlaced=true"}, .frames = 2};
  RunOptions everything = usual;
  everything.model_everything = true;
  const std::string scene = scene_of(std::string(kSphere) + kSpin);
  const Simulated a = show(scene, usual);
  const Simulated b = show(scene, everything);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_TRUE(same_picture(a.shown[k], b.shown[k]));
  EXPECT_EQ(a.result.modelled.fragments_kept, b.result.modelled.fragments_kept);
}

// A clipped picture: pieces and the guard band's grid in both fields.
TEST_F(InterlacedTest, WeavesWhatIsClipped) {
  const std::string scene =
      scene_of("[[object]]\ntype = \"uv_sphere\"\nmaterial = \"glaze\"\nradius = 4.0\n" + std::string(kSpin));
  const Simulated woven = shown(true, 2, {}, scene);
  const Simulated fields = shown(false, 4, {}, scene);
  for (std::size_t k = 0; k < 2; ++k) {
    expect_field(woven.shown[k], fields.shown[2 * k], 0);
    expect_field(woven.shown[k], fields.shown[2 * k + 1], 1);
  }
  expect_exact(woven, 5);
}

// An update that takes three fields comes in with even and odd lines in turn: fields 0, 3, 6, with the poses that are
// due one field after the one that was shown when it was begun.
TEST_F(InterlacedTest, AnUpdateMayComeInWithEitherField) {
  const std::vector<std::string> late{"host.sustained_mflops=0.4"};
  const Simulated woven = shown(true, 4, late);
  ASSERT_EQ(woven.result.deadlines.host.video_frames, 3U) << "this test's host is meant to take three fields";
  const std::int64_t poses[8] = {0, 0, 0, 1, 1, 1, 4, 4};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(woven.result.frames[k].animation_frame, poses[2 * k]) << k;
    EXPECT_EQ(woven.result.frames[k].last_animation_frame, poses[2 * k + 1]) << k;
  }
  expect_exact(woven, 4);
  EXPECT_NEAR(woven.result.answer.update_rate_hz, woven.result.answer.display_rate_hz / 3.0, 1e-6);
  const Simulated fields = shown(false, 8, late);
  for (std::size_t k = 0; k < 4; ++k) {
    expect_field(woven.shown[k], fields.shown[2 * k], 0);
    expect_field(woven.shown[k], fields.shown[2 * k + 1], 1);
  }
}

// The first picture begins with even lines: the initial load takes as many fields as frames of the other screen, or one
// more.
TEST_F(InterlacedTest, BeginsWithEvenLines) {
  bool odd = false;
  for (const char* mbit : {"20.0", "1.0", "0.6", "0.4"}) {
    const std::vector<std::string> set{std::string("host.link_mbit_per_s=") + mbit};
    const std::uint64_t frames = shown(false, 1, set).result.answer.initial_load_frames;
    odd = odd || frames % 2 == 1;
    EXPECT_EQ(shown(true, 1, set).result.answer.initial_load_frames, frames + frames % 2) << mbit;
  }
  EXPECT_TRUE(odd) << "none of these machines had to wait";
}

// 40 lines of a field: (333,333 - 10,000) / 40 = 8,083 clocks, and 13 left over.
TEST_F(InterlacedTest, CyclesAndTimesAreThoseOfTwoFields) {
  constexpr std::uint64_t kFrames = 3;
  constexpr std::uint64_t kField = 333'333;
  constexpr std::uint64_t kLine = 8'083;
  constexpr std::uint64_t kRetrace = 10'013;
  static_assert(kRetrace + 40 * kLine == kField);
  const run::Result result = shown(true, kFrames).result;
  constexpr std::uint64_t kLatency = 1 + 10 + 10;  // pre-normalisation, ten levels of the tree, shading
  for (std::uint64_t k = 0; k < kFrames; ++k) {
    const std::uint64_t first = kRetrace + kLine - kColumns + kLatency;
    EXPECT_EQ(result.frames[k].first_pixel_ps, (2 * k * kField + first) * 60'000) << k;
    EXPECT_EQ(result.frames[k].last_pixel_ps, ((2 * k + 1) * kField + first + 39 * kLine + kColumns - 1) * 60'000) << k;
  }
  for (const run::UnitFigures& unit : result.units)
    EXPECT_EQ(unit.busy + unit.starved + unit.blocked + unit.idle, unit.cycles) << unit.name;
  const run::UnitFigures& board = named(result.units, "object board 0");
  EXPECT_EQ(board.cycles, kFrames * 2 * kField);
  // Two copies, a line start for each line passed (line 79 is passed to twice: 2 x 80 - 1), and the pixels.
  EXPECT_EQ(board.busy, kFrames * (2 * 8 + (2 * kLines - 1) * 9 + kLines * kColumns));
  EXPECT_EQ(named(result.units, "video output").busy, kFrames * kLines * kColumns);
  EXPECT_EQ(named(result.links, "shading to video").bytes, kFrames * kLines * kColumns * 3);
  EXPECT_EQ(result.modelled.fragments_in, result.modelled.fragments_kept + result.modelled.fragments_hidden);
  EXPECT_DOUBLE_EQ(named(result.budgets, "line_start").used, 18);
  EXPECT_DOUBLE_EQ(named(result.budgets, "line_start").available, kLine - kColumns);
  // Rates are of fields.
  EXPECT_TRUE(result.interlaced);
  EXPECT_DOUBLE_EQ(result.answer.required_rate_hz, 50.0);
  EXPECT_NEAR(result.answer.display_rate_hz, 1e12 / (kField * 60'000.0), 1e-6);
  EXPECT_DOUBLE_EQ(result.answer.update_rate_hz, result.answer.display_rate_hz);
  EXPECT_EQ(result.answer.latency_frames, 1U);
  EXPECT_NEAR(result.answer.latency_first_pixel_us, (kField + kRetrace + kLine - kColumns + kLatency) * 0.06, 0.01);
  EXPECT_NEAR(result.answer.latency_last_pixel_us - result.answer.latency_first_pixel_us,
              (39 * kLine + kColumns - 1) * 0.06, 0.01);
}

}  // namespace
}  // namespace rastertlm::test
