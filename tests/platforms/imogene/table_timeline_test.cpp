// When the shading tables are loaded, and what the screen shows meanwhile.
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

// The camera turns: every frame has new tables. 6144 entries of 26 cycles at 3 MHz take 53.2 ms, three frames.
class LateTablesTest : public SimulationTest {
 protected:
  static constexpr std::uint64_t kFrames = 7;
  Simulated turned(std::vector<std::string> set) const {
    set.insert(set.end(), {"video.columns=64", "video.lines=64"});
    return show(
        scene_of(kSphere, std::string(kCamera) +
                              "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, 1.0]\ndeg_per_frame = 9.0\n"),
        {.set = set, .frames = kFrames});
  }
};

TEST_F(LateTablesTest, KeepTheOldPictureAndItsTables) {
  const Simulated simulated = turned({"loader.dot.clock_mhz=3.0"});
  constexpr std::uint64_t kLate = 3;
  EXPECT_NEAR(simulated.result.answer.update_rate_hz, 1e12 / (333'333 * 60'000.0) / kLate, 1e-6);
  EXPECT_FALSE(simulated.result.answer.sustained);
  EXPECT_EQ(simulated.result.answer.bottleneck.unit, "dot product loader");
  // The animation unit starts three messages to units, 19 cycles of 50 ns each; this one has a header and nine words of
  // the light, 11.5 cycles a byte, and 19 to start it.
  constexpr double kMessage = (3 * 19 + 19 + (8 + 9 * 4) * 11.5) * 0.05;
  EXPECT_NEAR(named(simulated.result.budgets, "tables.update").used, kMessage + 6144 * 26 / 3.0, 1e-3);
  for (std::size_t k = 1; k < kFrames; ++k)
    EXPECT_EQ(same_picture(simulated.shown[k], simulated.shown[k - 1]), k % kLate != 0) << "frame " << k;
  expect_exact(simulated, 5);
}

// In its retrace of 615.66 us a sequencer loads 6144 entries of 60 ns, and a 68000 does not.
TEST_F(LateTablesTest, OfOneBankAreLoadedInTheRetraceOrRefused) {
  const Simulated banks = turned({});
  const Simulated simulated = turned({"loader.kind=sequencer", "loader.when=retrace"});
  for (std::size_t k = 0; k < kFrames; ++k)
    EXPECT_TRUE(same_picture(simulated.shown[k], banks.shown[k])) << "frame " << k;
  EXPECT_NEAR(named(simulated.result.budgets, "tables.update").used, 6144 * 0.06, 1e-6);
  EXPECT_TRUE(simulated.result.answer.sustained);
  const run::UnitFigures& engine = named(simulated.result.units, "dot product loader");
  EXPECT_EQ(engine.busy, (kFrames - 1) * 6144);
  try {
    turned({"loader.when=retrace"});
    FAIL() << "19,968 us do not fit";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("19968 us"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("loader.when"), std::string::npos) << error.what();
  }
}

// 16 materials of 1024 entries of 18.5 cycles at 4 MHz take 75.8 ms, the two of the scene 9.5 ms, the one that is used
// 4.7 ms; dot products 20.0 ms.
TEST_F(LateTablesTest, FirstLoadIsOfTheMaterialsThatAreUsedOrOfAllOfTheMachine) {
  const std::string scene = scene_of(std::string(kSphere) + kSpin);
  const std::vector<std::string> slow{"video.columns=64", "video.lines=64", "loader.diffuse.clock_mhz=4.0",
                                      "host.link_mbit_per_s=1000.0"};  // the meshes are there at once
  const Simulated used = show(scene, {.set = slow, .frames = kFrames});
  std::vector<std::string> slow_all = slow;
  slow_all.emplace_back("loader.materials=all");
  const Simulated all = show(scene, {.set = slow_all, .frames = kFrames});
  EXPECT_EQ(used.result.answer.initial_load_frames, 1U);
  EXPECT_EQ(all.result.answer.initial_load_frames, 4U);
  for (std::size_t k = 0; k < kFrames; ++k) EXPECT_TRUE(same_picture(used.shown[k], all.shown[k])) << "frame " << k;
}

}  // namespace
}  // namespace rastertlm::test
