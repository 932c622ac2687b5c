// When the shading tables are loaded, and what the screen shows meanwhile.
#include <algorithm>
#include <cmath>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

// The camera turns: every frame has new tables. 6144 entries of 26 cycles at 3 MHz take 53.2 ms, three frames.
class LateTablesTest : public SimulationTest {
 protected:
  static constexpr std::uint64_t kFrames = 7;
  static constexpr std::size_t kSide = 64;
  // When the first pixel of a line reads the dot-product tables, from the retrace on. A line has 5047 pixel clocks, of
  // which 64 are shown; then one register stage of pre-normalisation, ten of the tree, four of the normaliser.
  static double read_us(std::size_t line) {
    return 0.06 * (333'333.0 - 64 * 5047 + 5047.0 * double(line) + (5047 - 64) + 1 + 10 + 4);
  }
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
  // The animation unit starts three messages to units, 19 cycles of 50 ns each, and writes a header of two words and
  // nine of the light, three cycles each.
  constexpr double kMessage = (3 * 19 + 11 * 3) * 0.05;
  EXPECT_NEAR(named(simulated.result.budgets, "tables.update").used, kMessage + 6144 * 26 / 3.0, 1e-3);
  for (std::size_t k = 1; k < kFrames; ++k)
    EXPECT_EQ(same_picture(simulated.shown[k], simulated.shown[k - 1]), k % kLate != 0) << "frame " << k;
  expect_exact(simulated, 5);
}

// Where loading RAMs are copied at every retrace the objects are those of a new frame at once, and the light is that of
// the old one for as long as its tables are late.
TEST_F(LateTablesTest, KeepTheOldLightOnNewObjectsWhereCopiesDoNotWait) {
  const Simulated global = turned({"loader.dot.clock_mhz=3.0"});
  const Simulated torn = turned({"loader.dot.clock_mhz=3.0", "host.swap=unconditional"});
  constexpr std::size_t kLate = 3;
  for (std::size_t k = 1; k < kFrames; ++k) {
    SCOPED_TRACE(k);
    const std::size_t whole =
        (k + kLate - 1) / kLate * kLate;  // the frame that shows the same objects, and their light
    if (whole >= kFrames) break;
    EXPECT_EQ(torn.shown[k].object, global.shown[whole].object);
    EXPECT_EQ(torn.shown[k].normal, global.shown[whole].normal);
    EXPECT_EQ(torn.shown[k].rgb == global.shown[whole].rgb, k == whole);
    EXPECT_EQ(torn.result.frames[k].late_table_lines, 0U);
  }
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
  for (const run::FrameFigures& frame : simulated.result.frames) EXPECT_EQ(frame.late_table_lines, 0U);
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

// One bank, loaded by 68000s from the retrace on: 19.968 ms. A line shows the tables as they are when its first pixel
// reads them, so the top has the old light, and each line below a little more of the new one.
TEST_F(LateTablesTest, OfOneBankAreShownHalfWrittenIfAskedFor) {
  const Simulated whole = turned({});
  const Simulated torn = turned({"loader.when=retrace", "loader.on_overrun=show"});
  // The last line of 64 reads its first entry 19,997 us after the retrace began, 29 us after the last is written; the
  // one before it reads at 19,694 us.
  ASSERT_LT(read_us(kSide - 2), 19'968.0);
  ASSERT_GT(read_us(kSide - 1), 19'968.0);
  for (std::size_t k = 0; k < kFrames; ++k) {
    const run::FrameFigures& frame = torn.result.frames[k];
    EXPECT_EQ(frame.late_table_lines, k == 0 ? 0U : kSide - 1) << "frame " << k;
    EXPECT_EQ(same_picture(torn.shown[k], whole.shown[k]), k == 0) << "frame " << k;
    EXPECT_EQ(torn.shown[k].object, whole.shown[k].object) << "frame " << k;
    EXPECT_EQ(torn.shown[k].normal, whole.shown[k].normal) << "frame " << k;
  }
  const run::Answer& answer = torn.result.answer;
  EXPECT_FALSE(answer.sustained);
  EXPECT_FALSE(answer.display_works);
  EXPECT_EQ(answer.bottleneck.unit, "dot product loader");
  ASSERT_EQ(answer.limits.size(), 1U);
  EXPECT_NE(answer.limits[0].find("tables.update needs 19968 us and has"), std::string::npos) << answer.limits[0];
  ASSERT_EQ(torn.result.warnings.size(), 1U);
  EXPECT_NE(torn.result.warnings[0].find("378 lines of 6 frames were shaded from half-written tables: a load takes "
                                         "19968 us"),
            std::string::npos)
      << torn.result.warnings[0];
}

// A sequencer of 500 ns loads 6144 entries in 3.072 ms: the lines that its end comes too late for are counted, and all
// below are as if it had been in time.
TEST_F(LateTablesTest, LinesBehindTheEndOfTheLoadAreAsEver) {
  const Simulated torn = turned(
      {"loader.kind=sequencer", "loader.sequencer_clock_ns=500", "loader.when=retrace", "loader.on_overrun=show"});
  const Simulated whole = turned({"loader.kind=sequencer", "loader.when=retrace"});
  std::size_t late = 0;
  while (read_us(late) < 6144 * 0.5) ++late;
  ASSERT_GT(late, 4U);
  ASSERT_LT(late, 32U);
  const auto first = static_cast<std::ptrdiff_t>(3 * kSide * late);
  for (std::size_t k = 1; k < kFrames; ++k) {
    EXPECT_EQ(torn.result.frames[k].late_table_lines, late) << "frame " << k;
    const std::vector<std::uint8_t>& a = torn.shown[k].rgb;
    const std::vector<std::uint8_t>& b = whole.shown[k].rgb;
    EXPECT_TRUE(std::equal(a.begin() + first, a.end(), b.begin() + first)) << "frame " << k;
  }
}

// A plane has one normal on all of the screen, and reads one entry of each of the three tables of a dot product. Its
// colour changes where the x entry has been written, where the y entry has, and where the z entry has: on lines that
// follow from times alone.
TEST_F(LateTablesTest, TheColourOfAPlaneChangesWhereItsEntriesAreWritten) {
  const std::string plane = R"([[object]]
type = "triangles"
material = "glaze"
two_sided = true
positions = [[-5.0, 0.0, -3.2], [5.0, 0.0, -3.2], [0.0, 0.0, 5.0]]
normals = [[0.4, -0.7, 0.6], [0.4, -0.7, 0.6], [0.4, -0.7, 0.6]]
)";
  const Simulated torn =
      show(scene_of(plane, std::string(kCamera) + "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, "
                                                  "1.0]\ndeg_per_frame = 9.0\n"),
           {.set = {"video.columns=64", "video.lines=64", "loader.when=retrace", "loader.on_overrun=show"},
            .frames = 4,
            .reference = false});
  for (std::size_t k = 1; k < 4; ++k) {
    SCOPED_TRACE(k);
    const frame::Frame& frame = torn.shown[k];
    const std::size_t middle = kSide / 2;
    std::vector<std::size_t> changes;  // lines on which the middle column has another colour than above
    for (std::size_t line = 0; line < kSide; ++line) {
      const std::size_t here = kSide * line + middle;
      ASSERT_EQ(frame.object[here], 1U) << line;
      const std::size_t above = here - kSide;
      if (line > 0 && !std::equal(&frame.rgb[3 * here], &frame.rgb[3 * here + 3], &frame.rgb[3 * above]))
        changes.push_back(line);
    }
    // The first line that reads the x, y, z entry after it was written; a change above the first is not seen.
    std::vector<std::size_t> written;
    for (std::size_t c = 0; c < 3; ++c) {
      const double index = std::floor(2048 * std::abs(double(frame.normal[3 * middle + c])));
      std::size_t line = 0;
      while (read_us(line) < (2048 * double(c) + index + 1) * 3.25) ++line;
      if (line > 0) written.push_back(line);
    }
    EXPECT_EQ(changes, written);
  }
}

// With twice the loaders a load takes half of the time, and the picture of tables that are in time is the same.
TEST_F(LateTablesTest, LoadersThatShareTheWorkAreInTime) {
  const std::vector<std::string> slow{"loader.dot.cycles=52.0"};
  EXPECT_NEAR(turned(slow).result.answer.update_rate_hz, 25.0, 0.01);
  std::vector<std::string> shared = slow;
  shared.emplace_back("loader.dot.units=2");
  const Simulated two = turned(shared);
  EXPECT_NEAR(two.result.answer.update_rate_hz, 50.0, 0.01);
  const Simulated one = turned({});
  for (std::size_t k = 0; k < kFrames; ++k) EXPECT_TRUE(same_picture(one.shown[k], two.shown[k])) << "frame " << k;
  const run::UnitFigures& engine = named(two.result.units, "dot product loader");
  EXPECT_EQ(engine.busy, named(one.result.units, "dot product loader").busy);  // 3072 x 52 cycles, or 6144 x 26
  EXPECT_EQ(named(two.result.links, "dot product loader to tables").bytes,
            named(one.result.links, "dot product loader to tables").bytes);
}

// An engine's busy cycles are those of the words that each of its loaders has stored, in every mode, at the end of a
// run that cuts a load short as well: to a store of 26 cycles and the rounding of a load's start and end.
TEST_F(LateTablesTest, LoadersAreBusyForTheWordsThatTheyStore) {
  const std::string retrace = "loader.when=retrace";
  const std::string shown = "loader.on_overrun=show";
  const std::string slow = "loader.dot.clock_mhz=3.0";
  struct Case {
    std::vector<std::string> set;
    std::uint64_t loaders;
    std::uint64_t loads;  // that ended
  };
  for (const Case& c : {Case{{}, 2, kFrames}, Case{{slow}, 2, 2}, Case{{slow, "host.swap=unconditional"}, 2, 2},
                        Case{{retrace, shown}, 2, kFrames - 1}, Case{{retrace, shown, slow}, 2, 2},
                        Case{{"loader.dot.units=2"}, 4, kFrames}, Case{{slow, "loader.dot.units=2"}, 4, 3}}) {
    SCOPED_TRACE(c.set.empty() ? "as ever" : c.set.back());
    const Simulated simulated = turned(c.set);
    const run::LinkFigures& link = named(simulated.result.links, "dot product loader to tables");
    ASSERT_EQ(link.bits, 11 * c.loaders);
    const double stores = 8.0 * static_cast<double>(link.bytes) / link.bits;
    const run::UnitFigures& engine = named(simulated.result.units, "dot product loader");
    EXPECT_NEAR(static_cast<double>(engine.busy), 26 * stores, 26 + 2.0 * double(kFrames));
    const double load = 6144.0 * 2 / static_cast<double>(c.loaders);
    EXPECT_GE(stores, load * double(c.loads) - 1);
    EXPECT_LT(stores, load * double(c.loads + 1));
  }
}

}  // namespace
}  // namespace rastertlm::test
