// When pixels leave and where cycles go, against closed forms written out here from the design: nothing of the model's
// own arithmetic is used.
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

// 512 x 512 at 50 Hz with a pixel clock of 60 ns and a vertical retrace of 600 us: round(20 ms / 60 ns) = 333,333
// clocks, of which 10,000 are retrace; 323,333 / 512 = 631 a line and 261 left over, which join the retrace.
constexpr std::uint64_t kPeriodPs = 60'000;
constexpr std::uint64_t kFrame = 333'333;
constexpr std::uint64_t kLine = 631;
constexpr std::uint64_t kRetrace = 10'261;
constexpr std::uint64_t kBlanking = kLine - 512;
static_assert(kFrame == 512 * kLine + kRetrace);
constexpr std::uint64_t kShading = 4 + 3 + 1 + 2;  // normaliser, dot products, tables, adders

const std::string kTurningTriangle = R"([[object]]
type = "triangles"
two_sided = true
positions = [[-2.0, 0.0, -1.5], [2.0, 0.3, -1.0], [0.2, -0.2, 2.0]]
)" + std::string(kSpin);

std::uint64_t levels_of(std::uint64_t processors) {
  std::uint64_t levels = 0;
  while ((std::uint64_t{1} << levels) < processors) ++levels;
  return levels;
}

// Registers of the tree: pairs are compared, and whoever has no partner waits a level.
std::uint64_t tree_registers(std::uint64_t processors) {
  std::uint64_t registers = 0;
  for (std::uint64_t left = processors; left > 1;) {
    left = left / 2 + left % 2;
    registers += left;
  }
  return registers;
}

struct Size {
  std::uint64_t units;
  std::uint64_t processors;  // of each
};

std::ostream& operator<<(std::ostream& out, const Size& size) { return out << size.units << " x " << size.processors; }

class LatencyTest : public SimulationTest, public testing::WithParamInterface<Size> {
 protected:
  Simulated shown_by(const char* topology, std::uint64_t frames) const {
    return show(scene_of(kTurningTriangle),
                {.set = {"host.computation_units=" + std::to_string(GetParam().units),
                         "host.processors_per_unit=" + std::to_string(GetParam().processors),
                         std::string("decision_unit.topology=") + topology},
                 .frames = frames,
                 .reference = false,
                 .pictures = false});
  }
};

void expect_pixel_times(const run::Result& result, std::uint64_t latency) {
  for (std::size_t k = 0; k < result.frames.size(); ++k) {
    const std::uint64_t first = (k * kFrame + kRetrace + kBlanking + latency) * kPeriodPs;
    EXPECT_EQ(result.frames[k].first_pixel_ps, first) << "frame " << k;
    EXPECT_EQ(result.frames[k].last_pixel_ps, first + (511 * kLine + 511) * kPeriodPs) << "frame " << k;
  }
}

void expect_budget(const run::Result& result, const std::string& name, double used, double available) {
  const run::Budget& budget = named(result.budgets, name);
  EXPECT_DOUBLE_EQ(budget.used, used) << name;
  EXPECT_DOUBLE_EQ(budget.available, available) << name;
  EXPECT_EQ(budget.fits, used <= available) << name;
}

// One comparator a processor lies before the decision in a pipeline, one a level in a tree.
TEST_P(LatencyTest, IsItsClosedForm) {
  const std::uint64_t processors = GetParam().units * GetParam().processors;
  constexpr std::uint64_t kFrames = 2;
  constexpr std::uint64_t kLinkBits = 24 + 3 * 12 + 4;
  for (const bool pipeline : {false, true}) {
    SCOPED_TRACE(pipeline ? "pipeline" : "tree");
    const run::Result result = shown_by(pipeline ? "pipeline" : "tree", kFrames).result;
    const std::uint64_t decision = pipeline ? processors : levels_of(processors);
    expect_pixel_times(result, 1 + decision + kShading);
    EXPECT_EQ(named(result.logic, "decision unit: latency").count, decision);
    EXPECT_EQ(named(result.logic, "pixel to level: latency").count, 1 + decision + kShading);
    EXPECT_EQ(named(result.logic, "decision unit: depth comparators").count, pipeline ? processors : processors - 1);
    EXPECT_EQ(named(result.logic, "link between processors: one direction").count, kLinkBits / 2);
    EXPECT_EQ(named(result.logic, "object processor: link pins").count, pipeline ? kLinkBits : kLinkBits / 2);
    EXPECT_EQ(named(result.memories, "decision unit registers").total_bits(),
              kLinkBits * (pipeline ? processors : tree_registers(processors)));
    EXPECT_EQ(named(result.memories, "loading RAMs").total_bits(), processors * 7 * 3 * 24);
    EXPECT_EQ(named(result.memories, "backup RAMs").total_bits(), processors * 7 * 3 * 24);
    EXPECT_EQ(named(result.memories, "backup RAMs: C, kept").total_bits(), processors * 7 * 24);

    expect_budget(result, "line_start", 9, kBlanking);
    expect_budget(result, "frame_start", 8, kRetrace);
    expect_budget(result, "pipeline_skew", static_cast<double>(8 + (pipeline ? processors - 1 : 0)), kRetrace);
    expect_budget(result, "adder_delay", 48, 60);

    for (std::uint64_t board = 0; board < GetParam().units; ++board) {
      const run::UnitFigures& unit = named(result.units, "object board " + std::to_string(board));
      EXPECT_EQ(unit.cycles, kFrames * kFrame);
      EXPECT_EQ(unit.busy, kFrames * (8 + 512 * (9 + 512)));
      EXPECT_EQ(unit.idle, unit.cycles - unit.busy);
    }
    for (const char* name : {"decision unit", "shading processor", "video output"}) {
      EXPECT_EQ(named(result.units, name).cycles, kFrames * kFrame);
      EXPECT_EQ(named(result.units, name).busy, kFrames * 512 * 512);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Imogene, LatencyTest,
                         testing::Values(Size{1, 1}, Size{1, 2}, Size{3, 1}, Size{1, 5}, Size{7, 19}, Size{8, 128},
                                         Size{5, 205}, Size{1, 4095}, Size{32, 128}),
                         [](const auto& size) {
                           return std::to_string(size.param.units) + "x" + std::to_string(size.param.processors);
                         });

using TimingTest = SimulationTest;

TEST_F(TimingTest, AddsTheRegistersOfEveryStage) {
  const Simulated simulated =
      show(scene_of(kTurningTriangle),
           {.set = {"object_processor.prenormalisation_cycles=3", "object_processor.comparator_cycles=2",
                    "shading.latency.normaliser=7", "shading.latency.dot_product=11", "shading.latency.tables=13",
                    "shading.latency.adders=17"},
            .frames = 3,
            .reference = false});
  expect_pixel_times(simulated.result, 3 + 2 * 10 + 7 + 11 + 13 + 17);
}

// 640 x 480 at 60 Hz: round(416,666.67) clocks of 40 ns, 25,000 of retrace; 391,667 / 480 = 815 and 467 left over.
TEST_F(TimingTest, FollowsTheVideoTiming) {
  const Simulated simulated =
      show(scene_of(kTurningTriangle), {.set = {"video.columns=640", "video.lines=480", "video.refresh_hz=60.0",
                                                "video.pixel_clock_ns=40.0", "video.vertical_retrace_us=1000.0"},
                                        .frames = 2,
                                        .reference = false});
  constexpr std::uint64_t kVgaFrame = 416'667;
  constexpr std::uint64_t kVgaRetrace = 25'467;
  constexpr std::uint64_t kVgaLine = 815;
  static_assert(kVgaRetrace + 480 * kVgaLine == kVgaFrame);
  const run::FrameFigures& frame = simulated.result.frames.at(1);
  EXPECT_EQ(frame.first_pixel_ps, (kVgaFrame + kVgaRetrace + kVgaLine - 640 + 1 + 10 + kShading) * 40'000);
  EXPECT_EQ(frame.last_pixel_ps - frame.first_pixel_ps, (479 * kVgaLine + 639) * 40'000);
  expect_budget(simulated.result, "line_start", 9, kVgaLine - 640);
  expect_budget(simulated.result, "frame_start", 8, kVgaRetrace);
  expect_budget(simulated.result, "adder_delay", 48, 40);
  EXPECT_NEAR(simulated.result.obtained_refresh_hz, 25e6 / kVgaFrame, 1e-6);
  EXPECT_NEAR(simulated.result.answer.display_rate_hz, 25e6 / kVgaFrame, 1e-6);
  EXPECT_DOUBLE_EQ(simulated.result.answer.required_rate_hz, 60.0);
}

// A slice is clocked in one period: its delay is 4 ns a bit, and a line starts with 2 cycles a slice and 5.
TEST_F(TimingTest, WiderSlicesAreSlowerAndStartLinesSooner) {
  struct Slices {
    std::uint64_t bits, count;
  };
  for (const Slices& slices : {Slices{24, 1}, Slices{12, 2}, Slices{8, 3}, Slices{6, 4}, Slices{5, 5}, Slices{1, 24}}) {
    const Simulated simulated =
        show(scene_of(kTurningTriangle),
             {.set = {"object_processor.slice_bits=" + std::to_string(slices.bits)}, .reference = false});
    SCOPED_TRACE(slices.bits);
    const double delay = 4.0 * static_cast<double>(slices.bits);
    expect_budget(simulated.result, "adder_delay", delay, 60);
    expect_budget(simulated.result, "line_start", static_cast<double>(2 * slices.count + 5), kBlanking);
    EXPECT_EQ(simulated.result.answer.sustained, delay <= 60.0);
    EXPECT_EQ(simulated.result.answer.limits.size(), delay <= 60.0 ? 0U : 1U);
  }
}

// The last of 16,384 processors works so late that it cannot copy before the picture begins.
TEST_F(TimingTest, SaysThatAPipelineIsTooLongForTheRetrace) {
  const auto limits = [&](const char* topology) {
    return show(scene_of(kTurningTriangle), {.set = {"host.computation_units=16", "host.processors_per_unit=1024",
                                                     std::string("decision_unit.topology=") + topology},
                                             .reference = false})
        .result.answer.limits;
  };
  EXPECT_TRUE(limits("tree").empty());
  const std::vector<std::string> pipeline = limits("pipeline");
  ASSERT_EQ(pipeline.size(), 1U);
  EXPECT_NE(pipeline[0].find("pipeline_skew"), std::string::npos) << pipeline[0];
  EXPECT_NE(pipeline[0].find("16391"), std::string::npos) << pipeline[0];
}

// What went in came out, and every cycle of every unit is one of four.
TEST_F(TimingTest, ConservesCyclesWordsAndFragments) {
  const std::string moving_camera =
      std::string(kCamera) + "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, 1.0]\ndeg_per_frame = 3.0\n";
  struct Case {
    const char* name;
    std::string scene;
    std::vector<std::string> set;
  };
  const std::vector<Case> cases{
      {"still", scene_of(kSphere), {}},
      {"moving", scene_of(std::string(kSphere) + kSpin), {}},
      {"late host",
       scene_of(std::string(kSphere) + kSpin),
       {"host.computation_units=2", "host.processors_per_unit=512"}},
      {"moving camera", scene_of(kSphere, moving_camera), {}},
      {"late tables", scene_of(kSphere, moving_camera), {"loader.dot.clock_mhz=3.0"}},
      {"late tables beside copies that do not wait",
       scene_of(kSphere, moving_camera),
       {"loader.dot.clock_mhz=3.0", "host.swap=unconditional"}},
      {"half-written tables",
       scene_of(kSphere, moving_camera),
       {"loader.when=retrace", "loader.on_overrun=show", "loader.dot.clock_mhz=3.0"}},
      {"shared tables",
       scene_of(kSphere, moving_camera),
       {"loader.dot.units=3", "loader.diffuse.units=5", "loader.specular.units=2"}},
      {"sequencer", scene_of(kSphere, moving_camera), {"loader.kind=sequencer", "loader.when=retrace"}},
      {"pipeline",
       scene_of(std::string(kSphere) + kSpin),
       {"decision_unit.topology=pipeline", "host.link_topology=chain"}},
  };
  constexpr std::uint64_t kFrames = 5;
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const Simulated simulated = show(c.scene, {.set = c.set, .frames = kFrames, .reference = false});
    const run::Result& result = simulated.result;
    for (const run::UnitFigures& unit : result.units) {
      EXPECT_EQ(unit.busy + unit.starved + unit.blocked + unit.idle, unit.cycles) << unit.name;
      EXPECT_NEAR(static_cast<double>(unit.cycles), kFrames * kFrame * 60e-9 * unit.clock_hz, 1.0) << unit.name;
    }
    std::uint64_t covered = 0;
    std::uint64_t fragments = 0;
    for (const frame::Frame& frame : simulated.shown)
      for (std::size_t i = 0; i < frame.pixels(); ++i) {
        covered += frame.object[i] != 0 ? 1U : 0U;
        fragments += frame.coverage[i];
      }
    EXPECT_EQ(result.modelled.fragments_in, fragments);
    EXPECT_EQ(result.modelled.fragments_kept, covered);
    EXPECT_EQ(result.modelled.fragments_in, result.modelled.fragments_kept + result.modelled.fragments_hidden);
    std::uint64_t bus_bytes = 0;
    std::uint64_t boards = 0;
    for (const run::LinkFigures& link : result.links) {
      if (link.name.starts_with("bus ")) bus_bytes += link.bytes;
      if (link.name.starts_with("board ")) {
        EXPECT_EQ(link.bytes, kFrames * 512 * 512 * 8) << link.name;
        ++boards;
      }
    }
    // The bus counts from the first picture on.
    EXPECT_EQ(result.modelled.coefficients_sent, result.frames.at(0).words_sent + bus_bytes / 4);
    EXPECT_EQ(result.modelled.lines_total, boards * 512 * kFrames);
    EXPECT_EQ(named(result.links, "shading to video").bytes, kFrames * 512 * 512 * 3);
    EXPECT_EQ(named(result.links, "decision unit to shading").bytes, kFrames * 512 * 512 * 8);
  }
}

}  // namespace
}  // namespace rastertlm::test
