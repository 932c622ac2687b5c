// Do rate, budgets, headroom and what is said of them agree, whatever the machine?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

run::Result verdict_of(const std::string& mesh, const std::vector<std::string>& settings) {
  return simulation::unpacked(in_child([&] {
           const std::string source = RASTERTLM_SOURCE_DIR;
           const run::Inputs inputs = run::read_inputs(source + "/configs/machines/quadratic.toml",
                                                       source + "/configs/scenes/sphere_" + mesh + ".toml", settings);
           run::Options options;
           options.reference = false;
           return simulation::packed(run::simulate(inputs, options, [](const run::FramePixels&) {}), {});
         }))
      .result;
}

const run::Budget& budget_of(const run::Result& result, const std::string& name) {
  const auto found = std::find_if(result.budgets.begin(), result.budgets.end(),
                                  [&](const run::Budget& budget) { return budget.name == name; });
  if (found == result.budgets.end()) throw std::logic_error("no budget " + name);
  return *found;
}

bool tells(const std::vector<std::string>& sentences, const std::string& what) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& sentence) { return sentence.find(what) != std::string::npos; });
}

// Where pictures are whole: a machine that holds its rate has what it needs, and one that does not lacks something.
void expect_consistent(const run::Result& result, const std::string& what) {
  const run::Answer& answer = result.answer;
  const bool new_each_screen = answer.frame_rate_hz > 0.999 * answer.display_rate_hz;
  EXPECT_EQ(answer.sustained, new_each_screen) << what;
  EXPECT_EQ(answer.limits.empty(), answer.sustained) << what;
  EXPECT_EQ(budget_of(result, "frame.in_turn").fits, answer.sustained) << what;
  EXPECT_EQ(answer.headroom >= 0.0, answer.sustained) << what << ": " << answer.headroom;
  for (const run::Budget& budget : result.budgets) {
    EXPECT_TRUE(budget.fits || !budget.applies || !answer.sustained)
        << what << ": " << budget.name << " " << budget.used << " of " << budget.available;
  }
  EXPECT_GE(budget_of(result, "drawing.frame").used, 0.9999 * budget_of(result, "frame_store.frame").used) << what;
}

// In whole pixel clocks these are a hair below what is asked.
TEST(Verdict, IsOfTheRateThatTheDisplayObtains) {
  for (const char* rate : {"video.refresh_hz=30.0", "video.refresh_hz=40.0", "video.preset=vga_60"}) {
    const run::Result result = verdict_of("168", {rate, "host.sustained_mflops=1000.0", "frame_store.access_ns=5.0"});
    EXPECT_LT(result.answer.display_rate_hz, result.answer.required_rate_hz) << rate;
    EXPECT_TRUE(result.answer.sustained) << rate;
    expect_consistent(result, rate);
  }
}

// The shipped machine and 374 triangles: each unit alone has time left, and together they have not.
TEST(Verdict, NamesWhoWaitsWhereEveryUnitAloneKeepsUp) {
  const run::Result missed = verdict_of("374", {});
  EXPECT_FALSE(missed.answer.sustained);
  expect_consistent(missed, "374");
  for (const char* unit : {"set_up.frame", "span_unit.frame", "frame_store.frame", "drawing.frame"})
    EXPECT_TRUE(budget_of(missed, unit).fits) << unit;
  EXPECT_TRUE(tells(missed.answer.limits, "drawing waits"));
  for (const char* setting : {"host.sustained_mflops=400.0", "frame_store.access_ns=10.0", "frame_store.banks=2",
                              "frame_store.clear=false", "span_unit.shadow_sets=374"}) {
    const std::string path = std::string(setting).substr(0, std::string(setting).find('='));
    EXPECT_TRUE(tells(missed.answer.limits, path)) << path;
    const run::Result held = verdict_of("374", {setting});
    EXPECT_TRUE(held.answer.sustained) << setting;
    expect_consistent(held, setting);
  }
}

// The time of a frame in turn is the shortest in which the machine can show one.
TEST(Verdict, HoldsAtTheRateOfAFrameInTurnAndNotBeyond) {
  const double hertz = 1e6 / budget_of(verdict_of("374", {}), "frame.in_turn").used;
  const auto at = [&](double rate) { return verdict_of("374", {"video.refresh_hz=" + std::to_string(rate)}); };
  const run::Result below = at(0.998 * hertz);
  EXPECT_TRUE(below.answer.sustained);
  EXPECT_NEAR(below.answer.headroom, 0.002, 0.001);
  EXPECT_FALSE(at(1.002 * hertz).answer.sustained);
}

// Bursts of a screen begin with its lines, not in the retrace in which a frame is begun.
TEST(Verdict, OfASharedMemoryAgreesWithItsBudgets) {
  bool held = false, missed = false;
  for (const char* radius : {"200.0", "211.0", "214.0", "217.0", "220.0", "230.0"}) {
    const run::Result result =
        verdict_of("374", {"set_up.method=gouraud", "frame_store.scan_out=shared", "host.sustained_mflops=4000.0",
                           std::string("object[0].radius=") + radius});
    expect_consistent(result, radius);
    (result.answer.sustained ? held : missed) = true;
  }
  EXPECT_TRUE(held && missed);
}

// A frame of nothing is cleared, and shown at a retrace as any other.
TEST(Verdict, OfNothingIsTheDisplaysRate) {
  for (const char* clear : {"frame_store.clear=true", "frame_store.clear=false"}) {
    const run::Result result = verdict_of("168", {"camera.far=701.0", clear});
    EXPECT_DOUBLE_EQ(result.answer.frame_rate_hz, result.answer.display_rate_hz) << clear;
    EXPECT_TRUE(tells(result.warnings, "frame 0 shows nothing but the background")) << clear;
    expect_consistent(result, clear);
  }
}

TEST(Verdict, OfATornPictureIsThatItIsNotWhole) {
  const run::Result torn = verdict_of("168", {"frame_store.buffers=1", "frame_store.swap=completion"});
  EXPECT_GT(torn.answer.frame_rate_hz, torn.answer.required_rate_hz);
  EXPECT_FALSE(torn.answer.sustained);
  EXPECT_FALSE(torn.answer.display_works);
  EXPECT_EQ(torn.answer.torn_frames, 1U);
  EXPECT_TRUE(torn.frames.at(0).torn());
  EXPECT_TRUE(tells(torn.answer.limits, "torn"));
  const run::Result whole = verdict_of("168", {"frame_store.swap=completion"});
  EXPECT_TRUE(whole.answer.sustained && whole.answer.display_works);
  EXPECT_EQ(whole.answer.torn_frames, 0U);
}

// 2^-(bits + 1) (k^2 + k + 2) / 2 levels after the k steps of triangles of a thirtieth of the screen's width and more,
// and no more than across the screen: 9 bits are off by more than 255 levels there only.
TEST(Verdict, WarnsOfTheFractionBitsThatTheSceneNeeds) {
  EXPECT_FALSE(tells(verdict_of("374", {}).warnings, "fraction bits"));
  EXPECT_TRUE(tells(verdict_of("374", {"span_unit.fraction_bits=12"}).warnings, "12 fraction bits may be off by"));
  const run::Result few = verdict_of("374", {"span_unit.fraction_bits=2"});
  EXPECT_TRUE(tells(few.warnings, "off by any level"));
  const double across = budget_of(few, "span_unit.fraction").used;
  EXPECT_DOUBLE_EQ(across, std::ldexp((2048.0 * 2048 + 2048 + 2) / 2, -3));
}

}  // namespace
}  // namespace rastertlm::test
