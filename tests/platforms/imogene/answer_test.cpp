// Does the answer hold whatever is simulated of it? One frame must say what many say; a machine whose display does not
// keep up has no rate; a link never moves more than its peak.
#include <sstream>

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

// A line that says NO without brackets is what keeps the machine from its rate.
TEST_F(AnswerTest, NoBudgetThatAppliesIsMissedWhereTheAnswerIsSustained) {
  const std::string machines = RASTERTLM_SOURCE_DIR "/configs/machines/";
  const std::string orbit = RASTERTLM_SOURCE_DIR "/configs/scenes/teapot_orbit.toml";
  const std::string wired = "loader.kind=sequencer";
  const std::string retrace = "loader.when=retrace";
  const std::string instructions = "host.cost=instructions";
  struct Case {
    std::string machine;
    std::string scene;
    std::vector<std::string> set;
    bool sustained;
  };
  // Of 512 lines the retrace has 615.66 us: 6144 entries in 100.2 ns each.
  for (const Case& c : {Case{"imogene", orbit, {}, true},
                        {"imogene", orbit, {wired, retrace, "loader.sequencer_clock_ns=98"}, true},
                        {"imogene", orbit, {wired, retrace, "loader.sequencer_clock_ns=100"}, true},
                        {"imogene", orbit, {wired, "loader.sequencer_clock_ns=1000"}, true},
                        {"imogene", orbit, {"loader.dot.cycles=27"}, false},
                        {"imogene", kTeapot, {"host.bus_bits=8"}, true},
                        {"imogene", kTeapot, {instructions}, false},
                        {"imogene", kTeapot, {instructions, "host.computation_units=16"}, true},
                        {"imogene", kTeapot, {"object_processor.slice_bits=24"}, false},
                        {"imogene_late_tables", orbit, {}, false},
                        {"imogene_late_tables", kTeapot, {}, true},
                        {"vga_fpga", orbit, {}, true},
                        {"imogene_1024_interlaced", orbit, {}, true}}) {
    SCOPED_TRACE(c.machine + (c.set.empty() ? "" : ' ' + c.set.back()));
    const run::Result result = simulate(machines + c.machine + ".toml", c.scene,
                                        {.set = c.set, .frames = 3, .reference = false, .pictures = false})
                                   .result;
    EXPECT_EQ(result.answer.sustained, c.sustained);
    bool all_fit = true;
    for (const run::Budget& budget : result.budgets) {
      all_fit = all_fit && (budget.fits || !budget.applies);
      if (result.answer.sustained) {
        EXPECT_TRUE(budget.fits || !budget.applies) << budget.name;
      }
    }
    EXPECT_EQ(all_fit, result.answer.sustained);
  }
}

// Each cost model has its own keys, and refuses those of the other.
TEST_F(AnswerTest, ALateHostMovesWithTheKeysOfItsCostModel) {
  const std::string rate = "host.sustained_mflops";
  const std::string table = "host.instruction";
  for (const bool by_instructions : {false, true}) {
    SCOPED_TRACE(by_instructions ? "instructions" : "sustained");
    const run::Result result =
        teapot({by_instructions ? "host.cost=instructions" : "host.sustained_mflops=0.5"}, 1).result;
    ASSERT_EQ(result.answer.limits.size(), 1U);
    for (const std::string& text : {result.answer.limits[0], named(result.budgets, "host.update").moved_by,
                                    named(result.budgets, "host.flops").moved_by}) {
      EXPECT_NE(text.find(by_instructions ? table : rate), std::string::npos) << text;
      EXPECT_EQ(text.find(by_instructions ? rate : table), std::string::npos) << text;
    }
  }
}

// The words of the formula times its factors are its value: 24 bits are three words of 8, two of 16, one of 32.
TEST_F(AnswerTest, TheBusFormulaGivesItsValue) {
  for (const auto& [bits, bus_words] : {std::pair{"8", 3.0}, {"16", 2.0}, {"32", 1.0}}) {
    SCOPED_TRACE(bits);
    const run::Result result = teapot({std::string("host.bus_bits=") + bits, "host.bus_cycles_per_word=5"}, 1).result;
    const run::Budget& bus = named(result.budgets, "host.bus");
    std::istringstream formula(bus.source.substr(bus.source.find(": ") + 2));
    double words = 0.0;
    double bus_words_a_word = 0.0;
    double cycles = 0.0;
    std::string skipped;
    formula >> words >> skipped >> skipped >> bus_words_a_word >> skipped >> skipped >> skipped >> skipped >> skipped >>
        cycles;  // "1386 words x 3 bus words a word x 5 cycles"
    EXPECT_EQ(bus_words_a_word, bus_words);
    EXPECT_EQ(cycles, 5.0);
    EXPECT_EQ(bus.used, words * bus_words * 5.0) << bus.source;
    EXPECT_NE(bus.moved_by.find("host.bus_bits"), std::string::npos);
    EXPECT_NE(bus.moved_by.find("object_processor.word_bits"), std::string::npos);
  }
}

// Where nothing moves the update is what moving everything would take of arithmetic and bus, and says no more.
TEST_F(AnswerTest, AnUpdateOfAStillSceneIsArithmeticAndBus) {
  const auto budgets = [this](const std::string& scene) {
    return show(scene_of(scene), {.set = {"video.columns=64", "video.lines=64"}, .reference = false}).result.budgets;
  };
  const std::vector<run::Budget> still = budgets(kSphere);
  const run::Budget& update = named(still, "host.update");
  // Two pieces of work, each rounded up: 20 MHz / 1.5 Mflop/s.
  const double arithmetic = named(still, "host.flops").used * 20 / 1.5;
  EXPECT_NEAR(update.used, arithmetic + named(still, "host.bus").used, 2.0);
  EXPECT_NE(update.source.find(": arithmetic and bus;"), std::string::npos) << update.source;
  const std::vector<run::Budget> moving = budgets(std::string(kSphere) + kSpin);
  EXPECT_NE(named(moving, "host.update").source.find(": links, arithmetic, waiting"), std::string::npos);
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
