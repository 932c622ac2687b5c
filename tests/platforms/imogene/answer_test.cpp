// Does the answer hold whatever is simulated of it? One frame must say what many say; a machine whose display does not
// keep up has no rate; a link never moves more than its peak.
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

class AnswerTest : public SimulationTest {
 protected:
  Simulated teapot(std::vector<std::string> set, std::uint64_t frames) const {
    set.insert(set.end(), {"video.columns=64", "video.lines=64"});
    return simulate(kMachine, kTeapot, {.set = set, .frames = frames});
  }
  static constexpr std::uint64_t kMany = 5;
};

TEST_F(AnswerTest, OneFrameSaysWhatManySay) {
  // Hosts that need a little more than one frame, and more than three; some units of the blocks are late and others are
  // not.
  for (const std::vector<std::string>& set : {std::vector<std::string>{"host.sustained_mflops=1.3"},
                                              {"host.sustained_mflops=0.4"},
                                              {"host.assignment=block"},
                                              {"host.sustained_mflops=3.0"}}) {
    const Simulated one = teapot(set, 1);
    const Simulated many = teapot(set, kMany);
    EXPECT_EQ(one.result.answer.sustained, many.result.answer.sustained) << set.front();
    EXPECT_DOUBLE_EQ(one.result.answer.update_rate_hz, many.result.answer.update_rate_hz) << set.front();
  }
}

TEST_F(AnswerTest, OneFrameSaysWhatManySayOfALateLoader) {
  const std::string scene =
      scene_of(kSphere, std::string(kCamera) + "[[camera.animation]]\ntype = \"orbit\"\ndeg_per_frame = 9.0\n");
  for (const char* cycles : {"loader.dot.cycles=20.0", "loader.dot.cycles=27.0", "loader.dot.cycles=90.0"}) {
    const std::vector<std::string> set{"video.columns=64", "video.lines=64", cycles};
    const Simulated one = show(scene, {.set = set, .frames = 1});
    const Simulated many = show(scene, {.set = set, .frames = kMany});
    EXPECT_EQ(one.result.answer.sustained, many.result.answer.sustained) << cycles;
    EXPECT_DOUBLE_EQ(one.result.answer.update_rate_hz, many.result.answer.update_rate_hz) << cycles;
  }
}

TEST_F(AnswerTest, ADisplayThatDoesNotKeepUpIsNamed) {
  const Simulated slow_adder = teapot({"object_processor.slice_bits=24"}, 1);  // 96 ns of 60
  EXPECT_FALSE(slow_adder.result.answer.sustained);
  EXPECT_FALSE(slow_adder.result.answer.display_works);
  EXPECT_EQ(slow_adder.result.answer.bottleneck.unit, "object processors");
  EXPECT_LT(slow_adder.result.answer.headroom, 0.0);
  ASSERT_EQ(slow_adder.result.answer.limits.size(), 1U);
  EXPECT_NE(slow_adder.result.answer.limits[0].find("object_processor.slice_bits"), std::string::npos);
  EXPECT_TRUE(teapot({}, 1).result.answer.display_works);
}

// Rates whose cycles could not be counted, and units that the simulation has no room for.
TEST_F(AnswerTest, RefusesRatesAndNumbersThatCannotBeSimulated) {
  for (const std::string setting : {"host.clock_hz=1", "host.link_mbit_per_s=1e-6", "host.sustained_mflops=1e-300",
                                    "host.computation_units=65536", "video.refresh_hz=1e-9"}) {
    try {
      run::read_inputs(kMachine, kTeapot, {setting});
      ADD_FAILURE() << setting << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(setting.substr(0, setting.find('='))), std::string::npos)
          << error.what();
    }
  }
}

TEST_F(AnswerTest, NoLinkMovesMoreThanItsPeak) {
  const std::string scene =
      scene_of(std::string(kSphere) + kSpin,
               std::string(kCamera) + "[[camera.animation]]\ntype = \"orbit\"\ndeg_per_frame = 9.0\n");
  for (const std::vector<std::string>& set : {std::vector<std::string>{"host.bus_cycles_per_word=7"},
                                              {"loader.kind=sequencer"},
                                              {"host.link_bits_per_byte=20.0"}}) {
    std::vector<std::string> all = set;
    all.insert(all.end(), {"video.columns=64", "video.lines=64"});
    const Simulated simulated = show(scene, {.set = all, .frames = kMany});
    for (const run::LinkFigures& link : simulated.result.links) {
      EXPECT_LE(link.achieved_bytes_per_s, link.active_bytes_per_s * (1 + 1e-9)) << link.name;
      EXPECT_LE(link.active_bytes_per_s, link.peak_bytes_per_s * (1 + 1e-9)) << link.name;
    }
  }
}

}  // namespace
}  // namespace rastertlm::test
