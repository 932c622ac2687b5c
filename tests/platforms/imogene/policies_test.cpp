// Policies against each other: whatever copies, loads, weaves and is late, a report agrees with itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

class PoliciesTest : public SimulationTest {
 protected:
  std::string moving() const {
    return written(
        "moving.toml",
        scene_of(std::string(kSphere) + kSpin,
                 std::string(kCamera) +
                     "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, 1.0]\ndeg_per_frame = 9.0\n"));
  }
  static Simulated run(const std::string& scene, std::vector<std::string> set, bool reference = false) {
    set.insert(set.end(), {"video.columns=64", "video.lines=64"});
    return simulate(kMachine, scene, {.set = set, .frames = 5, .reference = reference});
  }
};

void expect_agrees(const run::Result& result) {
  for (const run::UnitFigures& unit : result.units) {
    EXPECT_EQ(unit.busy + unit.starved + unit.blocked + unit.idle, unit.cycles) << unit.name;
    for (const std::uint64_t part : {unit.busy, unit.starved, unit.blocked, unit.idle})
      EXPECT_LE(part, unit.cycles) << unit.name;
  }
  for (const run::LinkFigures& link : result.links) EXPECT_LE(link.utilisation, 1.0 + 1e-6) << link.name;
  std::uint64_t torn = 0;
  for (const run::FrameFigures& frame : result.frames) torn += frame.torn() ? 1U : 0U;
  EXPECT_EQ(result.answer.torn_frames, torn);
  for (const run::Budget& budget : result.budgets)
    EXPECT_TRUE(!result.answer.sustained || !budget.applies || budget.fits) << budget.name;
  EXPECT_EQ(result.answer.sustained, result.answer.limits.empty());
}

TEST_F(PoliciesTest, ReportsAgreeWithThemselves) {
  const std::string scene = moving();
  const std::vector<std::vector<std::string>> hosts{{},
                                                    {"host.sustained_mflops=0.2"},
                                                    {"host.link_mbit_per_s=0.05"},
                                                    {"host.bus_bits=8", "host.bus_cycles_per_word=400"}};
  const std::vector<std::vector<std::string>> loaders{
      {},
      {"loader.dot.clock_mhz=4.0"},
      {"loader.kind=sequencer", "loader.when=retrace", "loader.on_overrun=show", "loader.sequencer_clock_ns=400.0"}};
  for (const char* swap : {"global", "unconditional"})
    for (const char* interlaced : {"false", "true"})
      for (const auto& host : hosts)
        for (const auto& loader : loaders) {
          std::vector<std::string> set{std::string("host.swap=") + swap, std::string("video.interlaced=") + interlaced};
          set.insert(set.end(), host.begin(), host.end());
          set.insert(set.end(), loader.begin(), loader.end());
          SCOPED_TRACE(fmt::format("{}", fmt::join(set, " ")));
          const Simulated simulated = run(scene, set);
          expect_agrees(simulated.result);
          if (std::string(swap) == "global" && loader.size() < 2) {
            EXPECT_EQ(simulated.result.answer.torn_frames, 0U);
          }
        }
}

// Tables in time, hosts not: the old objects in the new light are torn, though no word of the new ones is in use.
TEST_F(PoliciesTest, OldObjectsInNewLightAreTorn) {
  const Simulated simulated = run(moving(), {"host.swap=unconditional", "host.computation_units=1",
                                             "host.processors_per_unit=1024", "host.sustained_mflops=0.2"});
  const run::FrameFigures& frame = simulated.result.frames.at(1);
  EXPECT_EQ(frame.words_ahead, 0U);
  EXPECT_TRUE(frame.light_apart);
  EXPECT_EQ(frame.animation_frame, 0);
  EXPECT_EQ(simulated.shown[1].object, simulated.shown[0].object);
  EXPECT_NE(simulated.shown[1].rgb, simulated.shown[0].rgb);
}

// Hosts in time, tables not: the objects are wholly the new ones, and are measured against their own pose.
TEST_F(PoliciesTest, NewObjectsInOldLightAreTornAndWhole) {
  const Simulated simulated = run(moving(), {"host.swap=unconditional", "loader.dot.clock_mhz=4.0"}, true);
  const run::FrameFigures& frame = simulated.result.frames.at(1);
  EXPECT_EQ(frame.animation_frame, 1);
  EXPECT_EQ(frame.words_ahead, 0U);
  EXPECT_TRUE(frame.light_apart);
  EXPECT_GT(frame.words_sent, 0U);
  EXPECT_EQ(error_of(frame, "snapped").covered_missing, 0U);
  EXPECT_EQ(error_of(frame, "snapped").covered_extra, 0U);
  // Its tables come a frame later, with nothing else new.
  EXPECT_FALSE(simulated.result.frames.at(2).light_apart);
  EXPECT_EQ(simulated.result.frames.at(2).animation_frame, 1);
  EXPECT_EQ(simulated.shown[2].object, simulated.shown[1].object);
}

TEST_F(PoliciesTest, CopiesThatDoNotEndBeforeTheNextAreRefused) {
  const auto refused = [&](const std::vector<std::string>& set, const std::string& key, const std::string& text) {
    try {
      run(moving(), set);
      FAIL() << "not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(key + ": "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  refused({"decision_unit.topology=pipeline", "host.swap=unconditional", "host.processors_per_unit=100000"},
          "host.swap", "800007 pixel clocks");
  refused({"video.vertical_retrace_us=0.0", "video.refresh_hz=62.5", "video.pixel_clock_ns=50.0"},
          "video.vertical_retrace_us", "the frame start takes 8 pixel clocks");
}

}  // namespace
}  // namespace rastertlm::test
