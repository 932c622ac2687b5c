// The figures of 004, section 5.3.6, from the report's result, and what each of them moves with.
#include <cmath>
#include <map>

#include "src/config/presets.h"
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

using Settings = std::vector<std::string>;

class TableBudgetTest : public SimulationTest {
 protected:
  // Budgets by name, of a small picture: none of them depends on its size.
  std::map<std::string, run::Budget> budgets(Settings set = {}) const {
    set.insert(set.end(), {"video.columns=64", "video.lines=64"});
    std::map<std::string, run::Budget> found;
    for (const run::Budget& budget :
         show(scene_of(kSphere), {.set = set, .reference = false, .pictures = false}).result.budgets)
      found.emplace(budget.name, budget);
    return found;
  }
  void expect(const Settings& set, const std::string& name, double used, double available, bool fits) const {
    const run::Budget budget = budgets(set).at(name);
    EXPECT_NEAR(budget.used, used, 1e-6 * used) << name;
    EXPECT_NEAR(budget.available, available, 1e-6 * available) << name;
    EXPECT_EQ(budget.fits, fits) << name;
    EXPECT_FALSE(budget.source.empty()) << name;
    EXPECT_FALSE(budget.moved_by.empty()) << name;
  }
};

constexpr double kFrameUs = 333'333 * 0.06;

// Of a path of 12 cycles an input and 8 an output but the first, how many moves fit the share of one of 16 materials
// behind the 8 cycles of its arguments: 80 ns each.
double path_moves(double us, double inputs, double outputs) {
  const double moves = inputs + outputs - 1;
  const double path_us = (12 * inputs + 8 * (outputs - 1)) * 0.08;
  return std::floor((us / 16 - 8 * 0.08) * moves / path_us);
}

TEST_F(TableBudgetTest, GivesTheFiguresOfThePaper) {
  const std::map<std::string, run::Budget> found = budgets();
  const auto expect = [&](const char* name, double used, double available, bool fits) {
    const run::Budget& budget = found.at(name);
    EXPECT_NEAR(budget.used, used, 1e-9 * used) << name;
    EXPECT_NEAR(budget.available, available, 1e-9 * available) << name;
    EXPECT_EQ(budget.fits, fits) << name;
    EXPECT_FALSE(budget.source.empty()) << name;
    EXPECT_FALSE(budget.moved_by.empty()) << name;
  };
  EXPECT_EQ(found.at("dot_table.words").used, 6144);
  expect("dot_table.load_sequencer", 368.64, 600.0, true);  // "about 370 us, again the 600 us"
  expect("dot_table.load_68000", 6144 * 26 / 8.0, kFrameUs, true);
  EXPECT_EQ(found.at("diffuse.words").used, 16384);
  expect("diffuse.load_sequencer", 983.04, 600.0, false);
  expect("diffuse.load_68000", 16384 * 18.5 / 16, kFrameUs, true);
  expect("diffuse9.load_sequencer", 491.52, 600.0, true);  // "Only 9 bits may be needed"
  EXPECT_EQ(found.at("specular.words").used, 16384);
  expect("specular.load_sequencer", 1228.8, 600.0, false);
  expect("specular.load_68000", 16 * (1024 * 12 + 256 * 8) / 12.5, kFrameUs, true);
  expect("specular.paper_19ms", 18350.08, 19000.0, true);
  expect("path_rom.moves", 1024 + 256 - 1, path_moves(kFrameUs, 1024, 256), true);
  expect("adder_delay", 48.0, 60.0, true);
  expect("adder_delay_unsliced", 96.0, 60.0, false);
  expect("table_access", 50.0, 60.0, true);
  expect("table_store", 50.0, 960.0, true);  // the specular 68000: 12 cycles of 80 ns
  expect("reload.camera", 19968.0, kFrameUs, true);
  expect("reload.material", 1184.0, kFrameUs, true);
  expect("reload.light_colour", 18944.0, kFrameUs, true);
}

// The clock of the paper's text misses its own claim.
TEST_F(TableBudgetTest, SpecularAtTwelveMegahertzMissesTheClaimAndFitsTheFrame) {
  const Settings twelve{"loader.specular.preset=move_l_add_l_12_mhz"};
  expect(twelve, "specular.paper_19ms", 229'376 / 12.0, 19000.0, false);  // 19,114.67 us
  expect(twelve, "specular.load_68000", 229'376 / 12.0, kFrameUs, true);
  EXPECT_NE(budgets(twelve).at("specular.paper_19ms").source.find("less than 19 ms"), std::string::npos);
}

// Each loop by its name: MC68000 instruction times, no wait states; add.l 8, add.w 4, addx.w 4, swap 4, move.w 8,
// move.l 12, dbra 10.
TEST_F(TableBudgetTest, EveryLoopCanBeAskedFor) {
  struct Loop {
    std::string preset;
    double us;
    bool fits;
  };
  const std::map<std::string, std::vector<Loop>> loops{
      {"dot",
       {{"add_l_move_w", 6144 * (8 + 8 + 10) / 8.0, true},
        {"add_w_addx_w_move_w", 6144 * (4 + 4 + 8 + 10) / 8.0, true},
        {"add_l_swap_move_w", 6144 * (8 + 4 + 8 + 4 + 10.0 / 8) / 8.0, true},
        {"add_l_move_l", 6144 * (8 + 12 + 10) / 8.0, false}}},
      {"diffuse",
       {{"add_l_move_w", 16384 * (8 + 8 + 10.0 / 4) / 16, true},
        {"add_w_addx_w_move_w", 16384 * (4 + 4 + 8 + 10.0 / 4) / 16, true},
        {"add_l_move_l", 16384 * (8 + 12) / 16.0, false}}},
      {"specular",
       {{"move_l_add_l", 16 * (1024 * 12 + 256 * 8) / 12.5, true},
        {"move_l_add_l_12_mhz", 16 * (1024 * 12 + 256 * 8) / 12.0, true},
        {"move_w_add_l", 16 * (1024 * 8 + 256 * 8) / 12.0, true},
        {"move_l_add_w", 16 * (1024 * 12 + 256 * 4) / 12.0, true}}},
  };
  for (const auto& [table, of_table] : loops) {
    const std::string name = (table == "dot" ? "dot_table" : table) + ".load_68000";
    EXPECT_EQ(config::Presets::compiled_in().names("loader." + table).size(), of_table.size()) << table;
    for (const Loop& loop : of_table) {
      SCOPED_TRACE(table + ' ' + loop.preset);
      const Settings set{"loader." + table + ".preset=" + loop.preset};
      expect(set, name, loop.us, kFrameUs, loop.fits);
      EXPECT_NE(budgets(set).at(name).source.find(loop.preset), std::string::npos);
    }
  }
}

TEST_F(TableBudgetTest, UnrollingDecidesWhatFits) {
  for (const auto& [unroll, fits] : std::map<int, bool>{{1, false}, {2, false}, {3, true}, {8, true}, {16, true}})
    expect({"loader.diffuse.unroll=" + std::to_string(unroll)}, "diffuse.load_68000", 1024 * (16 + 10.0 / unroll),
           kFrameUs, fits);
  expect({"loader.dot.preset=add_l_move_l", "loader.dot.unroll=2"}, "dot_table.load_68000", 19200.0, kFrameUs, true);
  expect({"loader.dot.preset=add_l_move_l", "loader.dot.unroll=0"}, "dot_table.load_68000", 15360.0, kFrameUs, true);
  expect({"loader.diffuse.preset=add_l_move_l", "loader.diffuse.clock_mhz=16.67"}, "diffuse.load_68000",
         16384 * 20 / 16.67, kFrameUs, true);
}

// Every figure with each of its parameters: the value that it must have then.
TEST_F(TableBudgetTest, EachMovesWithItsParameters) {
  const Settings wired{"loader.kind=sequencer"};
  const auto with = [](Settings set, const std::string& more) {
    set.push_back(more);
    return set;
  };
  EXPECT_EQ(budgets({"shading.dot_table_address_bits=12"}).at("dot_table.words").used, 3 * 4096);
  EXPECT_EQ(budgets({"shading.materials=8"}).at("diffuse.words").used, 8 * 1024);
  EXPECT_EQ(budgets({"shading.materials=8"}).at("specular.words").used, 8 * 1024);
  const Settings nine{"shading.index_bits=9"};
  expect(nine, "diffuse.load_68000", 8192 * 18.5 / 16, kFrameUs, true);
  expect(nine, "diffuse.load_sequencer", 491.52, 600.0, true);
  expect(nine, "path_rom.moves", 512 + 256 - 1, path_moves(kFrameUs, 512, 256), true);
  expect({"shading.level_bits=7"}, "path_rom.moves", 1024 + 128 - 1, path_moves(kFrameUs, 1024, 128), true);
  // 20 ms / 16 materials / 60 ns, and a step for the arguments; the retrace, 5 of 10,005 clocks longer at 64 lines.
  expect(wired, "path_rom.moves", 1279, std::floor(333'333 / 16.0) - 1, true);
  expect(with(wired, "loader.when=retrace"), "path_rom.moves", 1279, std::floor(10'005 / 16.0) - 1, false);
  expect(with(with(wired, "loader.when=retrace"), "loader.specular.units=3"), "path_rom.moves", 1279,
         std::floor(10'005 / 6.0) - 1, true);
  // Clocks that would fit the retrace: 36.6 and 29.3 ns.
  expect(with(wired, "loader.sequencer_clock_ns=36.6"), "diffuse.load_sequencer", 599.6544, 600.0, true);
  expect(with(wired, "loader.sequencer_clock_ns=36.7"), "diffuse.load_sequencer", 601.2928, 600.0, false);
  expect(with(wired, "loader.sequencer_clock_ns=29.2"), "specular.load_sequencer", 598.016, 600.0, true);
  expect(with(wired, "loader.sequencer_clock_ns=29.3"), "specular.load_sequencer", 600.064, 600.0, false);
  expect(with(wired, "loader.sequencer_clock_ns=70"), "diffuse9.load_sequencer", 573.44, 600.0, true);
  expect({"loader.argument_cycles=0"}, "specular.load_sequencer", 1227.84, 600.0, false);
  expect({"video.vertical_retrace_us=1000"}, "diffuse.load_sequencer", 983.04, 1000.0, true);
  expect({"loader.dot.clock_mhz=10"}, "dot_table.load_68000", 15974.4, kFrameUs, true);
  expect({"loader.specular.units=2"}, "specular.load_sequencer", 8 * 1280 * 0.06, 600.0, false);
  expect({"loader.specular.units=3"}, "specular.load_sequencer", 6 * 1280 * 0.06, 600.0, true);
  expect({"loader.diffuse.units=2"}, "diffuse.load_sequencer", 491.52, 600.0, true);
  expect({"loader.dot.units=3"}, "dot_table.load_sequencer", 2049 * 0.06, 600.0, true);
  expect({"shading.preset=cy7c162_45"}, "table_access", 60.0, 60.0, true);
  expect({"shading.table_access_ns=45.5"}, "table_access", 60.5, 60.0, false);
  expect({"loader.specular.clock_mhz=20"}, "table_store", 50.0, 600.0, true);
  // The diffuse loader: 16 cycles of 62.5 ns between two entries of a pass, 26 where each entry is a pass.
  expect({"loader.specular.clock_mhz=1"}, "table_store", 50.0, 1000.0, true);
  expect({"loader.specular.clock_mhz=1", "loader.diffuse.unroll=1"}, "table_store", 50.0, 1625.0, true);
  expect({"loader.specular.clock_mhz=1", "loader.diffuse.cycles=12"}, "table_store", 50.0, 750.0, true);
  expect({"object_processor.slice_bits=8"}, "adder_delay", 32.0, 60.0, true);
  expect({"object_processor.adder_ns_per_bit=2.5"}, "adder_delay_unsliced", 60.0, 60.0, true);
}

// What a line says of itself: the loader whose time it is, and the share that it is of.
TEST_F(TableBudgetTest, NamesTheKeysOfTheLoaderThatItIsOf) {
  const auto moved_by = [this](const Settings& set) { return budgets(set).at("table_store").moved_by; };
  EXPECT_NE(moved_by({}).find("loader.specular.clock_mhz"), std::string::npos);
  EXPECT_EQ(moved_by({}).find("loader.diffuse"), std::string::npos);
  const std::string slow = "loader.specular.clock_mhz=1";
  EXPECT_NE(moved_by({slow}).find("loader.diffuse.clock_mhz"), std::string::npos);
  EXPECT_EQ(moved_by({slow}).find("loader.specular"), std::string::npos);
  EXPECT_NE(moved_by({slow, "loader.diffuse.cycles=12"}).find("loader.diffuse.cycles"), std::string::npos);
}

// 6144 x 98 ns are more than the 600 us that the paper has, and less than the 10,261 clocks of 60 ns that 512 lines
// leave: what the machine depends on is the second.
TEST_F(TableBudgetTest, TheRetraceThatAppliesIsTheObtainedOne) {
  const run::Result result =
      show(scene_of(kSphere, std::string(kCamera) + "[[camera.animation]]\ntype = \"orbit\"\ndeg_per_frame = 9.0\n"),
           {.set = {"video.columns=64", "loader.kind=sequencer", "loader.when=retrace", "loader.sequencer_clock_ns=98"},
            .frames = 3,
            .reference = false,
            .pictures = false})
          .result;
  const auto expect = [&result](const char* name, double available, bool fits, bool applies) {
    const run::Budget& budget = named(result.budgets, name);
    EXPECT_NEAR(budget.used, 6144 * 0.098, 1e-6) << name;
    EXPECT_NEAR(budget.available, available, 1e-6) << name;
    EXPECT_EQ(budget.fits, fits) << name;
    EXPECT_EQ(budget.applies, applies) << name;
  };
  expect("dot_table.load_sequencer", 600.0, false, false);
  expect("tables.update", 10'261 * 0.06, true, true);
  EXPECT_TRUE(result.answer.sustained);
  EXPECT_EQ(result.answer.bottleneck.unit, "dot product loader");
  EXPECT_NO_THROW(named(result.units, result.answer.bottleneck.unit));
}

// A memory that is too slow for the pixel clock, or for its sequencer, makes a display that does not work.
TEST_F(TableBudgetTest, MemoriesThatAreTooSlowAreNamed) {
  const auto answer = [&](Settings set) {
    set.insert(set.end(), {"video.columns=64", "video.lines=64"});
    return show(scene_of(kSphere), {.set = set, .reference = false, .pictures = false}).result.answer;
  };
  const run::Answer slow = answer({"shading.table_access_ns=50"});
  EXPECT_FALSE(slow.display_works);
  EXPECT_EQ(slow.bottleneck.unit, "shading processor");
  ASSERT_EQ(slow.limits.size(), 1U);
  EXPECT_NE(slow.limits[0].find("table_access needs 65 ns and has 60"), std::string::npos) << slow.limits[0];
  const run::Answer wired = answer({"loader.kind=sequencer", "loader.sequencer_clock_ns=40"});
  EXPECT_FALSE(wired.display_works);
  EXPECT_EQ(wired.bottleneck.unit, "table loader");
  ASSERT_EQ(wired.limits.size(), 1U);
  EXPECT_NE(wired.limits[0].find("table_store needs 50 ns and has 40"), std::string::npos) << wired.limits[0];
  EXPECT_TRUE(answer({}).display_works);
}

}  // namespace
}  // namespace rastertlm::test
