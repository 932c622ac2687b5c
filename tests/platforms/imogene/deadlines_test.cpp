// Is what is left of every line, retrace and update its closed form, and does it move with what it depends on? The
// forms are written out here from the design; nothing of the model's own arithmetic is used.
#include "src/run/deadlines.h"

#include <cmath>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

const std::string kTurning = scene_of(std::string(kSphere) + kSpin);
const std::string kTurningCamera =
    scene_of(kSphere, std::string(kCamera) +
                          "[[camera.animation]]\ntype = \"orbit\"\naxis = [0.2, 0.0, 1.0]\ndeg_per_frame = 3.0\n");

// 512 x 512 at 50 Hz, 60 ns: 333,333 = 512 x 631 + 10,261; a copy takes 8 clocks, a line start 2 n + 5 for n slices.
struct Case {
  const char* name;
  std::vector<std::string> set;
  std::int64_t first_line;   // what is left of line 0, which has the retrace too
  std::int64_t second_line;  // of line 1
  std::int64_t other_lines;
  std::int64_t retrace;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

const Case kCases[] = {
    {"default", {}, 10'261 + 119 - 8 - 9, 119 - 9, 119 - 9, 10'261 - 8},
    {"four_slices", {"object_processor.slice_bits=6"}, 10'380 - 8 - 13, 119 - 13, 119 - 13, 10'253},
    {"one_slice", {"object_processor.slice_bits=24"}, 10'380 - 8 - 7, 119 - 7, 119 - 7, 10'253},
    {"pipeline", {"decision_unit.topology=pipeline"}, 10'380 - 1023 - 8 - 9, 110, 110, 10'261 - 1023 - 8},
    {"slow_comparators",
     {"decision_unit.topology=pipeline", "object_processor.comparator_cycles=3"},
     10'380 - 3 * 1023 - 8 - 9,
     110,
     110,
     10'261 - 3 * 1023 - 8},
    {"fewer_processors",
     {"decision_unit.topology=pipeline", "host.processors_per_unit=100"},
     10'380 - 799 - 8 - 9,
     110,
     110,
     10'261 - 799 - 8},
    {"narrower", {"video.columns=500"}, 10'261 + 131 - 8 - 9, 131 - 9, 131 - 9, 10'253},
    // 16 MHz: 320,000 = 512 x 606 + 9,728.
    {"slower_clock", {"video.pixel_clock_ns=62.5"}, 9'728 + 94 - 8 - 9, 94 - 9, 94 - 9, 9'728 - 8},
    // 400 us: 6,667 clocks; (333,333 - 6,667) / 512 = 638, and 10 left over.
    {"short_retrace", {"video.vertical_retrace_us=400.0"}, 6'677 + 126 - 8 - 9, 126 - 9, 126 - 9, 6'677 - 8},
    // 60 Hz: 277,778 = 512 x 523 + 10,002.
    {"sixty_hertz", {"video.refresh_hz=60.0"}, 10'002 + 11 - 8 - 9, 11 - 9, 11 - 9, 10'002 - 8},
    // A field of 256 lines: (333,333 - 10,000) / 256 = 1263, and 5 left over; lines go on by two, the first by one.
    {"interlaced", {"video.interlaced=true"}, 10'005 + 751 - 8 - 9, 10'005 + 751 - 8 - 18, 751 - 18, 10'005 - 8},
};

class DeadlineTest : public SimulationTest, public testing::WithParamInterface<Case> {};

TEST_P(DeadlineTest, EqualsItsClosedForm) {
  const Case& c = GetParam();
  const run::Result result = show(kTurning, {.set = c.set, .frames = 2, .reference = false, .pictures = false}).result;
  const run::Deadlines& d = result.deadlines;
  ASSERT_EQ(d.lines.slack_cycles.size(), 512U);
  for (std::size_t line = 0; line < 512; ++line)
    EXPECT_EQ(d.lines.slack_cycles[line], line == 0 ? c.first_line : line == 1 ? c.second_line : c.other_lines) << line;
  EXPECT_EQ(d.lines.worst.slack_cycles, c.other_lines);
  EXPECT_EQ(d.lines.worst.frame, 0U);
  EXPECT_EQ(d.lines.worst.line, c.second_line == c.other_lines ? 1U : 2U);
  EXPECT_EQ(d.lines.worst.needs, "line start");
  EXPECT_EQ(d.lines.worst.available_cycles, d.lines.available_cycles);
  EXPECT_EQ(static_cast<std::int64_t>(d.lines.worst.available_cycles - d.lines.worst.needed_cycles), c.other_lines);
  EXPECT_EQ(d.retrace.slack_cycles, c.retrace);
  EXPECT_EQ(d.retrace.needs, "frame start");
  EXPECT_EQ(d.retrace.tables_cycles, 0U);
  for (const run::FrameFigures& frame : result.frames) {
    EXPECT_EQ(frame.line_slack_cycles, c.other_lines);
    EXPECT_EQ(frame.retrace_slack_cycles, c.retrace);
  }
  // The same needs as the budgets'.
  const run::Budget& line_start = named(result.budgets, "line_start");
  EXPECT_DOUBLE_EQ(line_start.available - line_start.used, static_cast<double>(c.other_lines));
  const run::Budget& skew = named(result.budgets, "pipeline_skew");
  EXPECT_DOUBLE_EQ(skew.available - skew.used, static_cast<double>(c.retrace));
}

INSTANTIATE_TEST_SUITE_P(Imogene, DeadlineTest, testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

using DeadlinesTest = SimulationTest;

// 6144 entries of a dot product table by the sequencer, beside what the boards do in the retrace. The first frame's
// tables were loaded before it.
TEST_F(DeadlinesTest, ALoadInTheRetraceIsPartOfIt) {
  for (const std::uint64_t ns : {50U, 67U, 100U}) {
    SCOPED_TRACE(ns);
    const run::Result result = show(kTurningCamera, {.set = {"loader.kind=sequencer", "loader.when=retrace",
                                                             "loader.sequencer_clock_ns=" + std::to_string(ns) + ".0"},
                                                     .frames = 3,
                                                     .reference = false,
                                                     .pictures = false})
                                   .result;
    const auto load = static_cast<std::int64_t>((6144 * ns + 59) / 60);  // pixel clocks
    const run::Deadlines& d = result.deadlines;
    EXPECT_EQ(d.retrace.tables_cycles, static_cast<std::uint64_t>(load));
    EXPECT_EQ(d.retrace.slack_cycles, 10'261 - load);
    EXPECT_EQ(d.retrace.needs, "table load");
    EXPECT_EQ(d.retrace.frame, 1U);
    EXPECT_NEAR(d.retrace.slack_us, static_cast<double>(10'261 - load) * 0.06, 1e-3);
    EXPECT_EQ(result.frames[0].retrace_slack_cycles, 10'253);
    EXPECT_EQ(result.frames[2].retrace_slack_cycles, 10'261 - load);
    // A line's first pixel reads the dot product tables 119 clocks of blanking, one of pre-normalisation, ten of the
    // tree and four of the normaliser after it has begun. Line 0 waits for the tables; line 1 only if they are later
    // than its own start leaves.
    const std::int64_t wait = load - 119 - 1 - 10 - 4;
    EXPECT_EQ(d.lines.slack_cycles[0], std::min<std::int64_t>(10'363, 10'261 - wait));
    EXPECT_EQ(d.lines.slack_cycles[1], std::min<std::int64_t>(110, 10'261 + 631 - wait));
  }
}

// Shown from half-written tables: as many lines are late as the loader counts, and the worst is the first.
TEST_F(DeadlinesTest, CountsTheLinesOfLateTables) {
  const Simulated simulated =
      show(kTurningCamera, {.set = {"loader.kind=sequencer", "loader.when=retrace", "loader.on_overrun=show",
                                    "loader.sequencer_clock_ns=150.0"},
                            .frames = 3,
                            .reference = false});
  const run::Deadlines& d = simulated.result.deadlines;
  // 6144 x 150 ns are 15,360 clocks; 10,261 + 631 x line + 134 clocks is when a line's first pixel reads them.
  constexpr std::int64_t kWait = 15'360 - 134;
  for (std::int64_t line = 0; line < 512; ++line)
    EXPECT_EQ(d.lines.slack_cycles[static_cast<std::size_t>(line)],
              std::min<std::int64_t>(line == 0 ? 10'363 : 110, 10'261 + 631 * line - kWait))
        << line;
  EXPECT_EQ(d.lines.worst.line, 0U);
  EXPECT_EQ(d.lines.worst.frame, 1U);
  EXPECT_EQ(d.lines.worst.needs, "table load");
  EXPECT_EQ(d.lines.worst.available_cycles, 10'261U);
  EXPECT_EQ(d.lines.worst.needed_cycles, static_cast<std::uint64_t>(kWait));
  EXPECT_EQ(d.retrace.slack_cycles, 10'261 - 15'360);
  const auto late = std::count_if(d.lines.slack_cycles.begin(), d.lines.slack_cycles.end(),
                                  [](std::int64_t slack) { return slack < 0; });
  EXPECT_EQ(late, 8);
  EXPECT_EQ(simulated.result.frames.at(0).late_table_lines, 0U);
  for (const std::size_t frame : {1U, 2U}) {
    EXPECT_EQ(simulated.result.frames.at(frame).late_table_lines, static_cast<std::uint64_t>(late));
    EXPECT_EQ(simulated.result.frames.at(frame).line_slack_cycles, 10'261 - kWait);
  }
}

// Lines that start too soon for a load are late by the difference.
TEST_F(DeadlinesTest, NamesTheLinesThatALateTableSpoils) {
  video::VideoParameters parameters;
  const video::Timing timing = video::timing(parameters);
  const run::BoardNeeds needs{Cycles(9), Cycles(8), Cycles(0)};
  constexpr std::int64_t kLoad = 20'000;
  for (std::int64_t line = 0; line < 512; ++line) {
    const run::Slack slack = run::line_slack(timing, needs, static_cast<std::size_t>(line), Cycles(kLoad));
    const std::int64_t tables = 10'261 + 631 * line - kLoad;
    const std::int64_t boards = line == 0 ? 10'363 : 110;
    EXPECT_EQ(slack.cycles(), std::min(tables, boards)) << line;
    EXPECT_STREQ(slack.needs, tables < boards ? "table load" : "line start") << line;
    EXPECT_EQ(slack.cycles() < 0, line <= 15) << line;
  }
  EXPECT_EQ(run::retrace_slack(timing, needs, Cycles(kLoad)).cycles(), 10'261 - kLoad);
  // Of interlaced video both fields' first lines come as soon after their retrace.
  parameters.interlaced = true;
  const video::Timing fields = video::timing(parameters);
  for (const std::size_t line : {0U, 1U})
    EXPECT_EQ(run::line_slack(fields, needs, line, Cycles(kLoad)).cycles(), 10'005 - kLoad);
}

// A moving object: its update's cycles are those of the budget, and what is left is a video frame less those, nothing
// where it is late.
TEST_F(DeadlinesTest, OfTheHostsIsWhatTheVideoFrameLeaves) {
  for (const char* mflops : {"1.5", "0.5", "0.3"}) {
    SCOPED_TRACE(mflops);
    const run::Result result =
        show(kTurning, {.set = {"video.columns=64", "video.lines=64", std::string("host.sustained_mflops=") + mflops},
                        .frames = 9,
                        .reference = false,
                        .pictures = false})
            .result;
    const run::Deadlines::Host& host = result.deadlines.host;
    constexpr double kFramePs = 333'333.0 * 60'000;
    const double used = named(result.budgets, "host.update").used;
    const double frames = std::ceil(used * 50'000 / kFramePs);
    EXPECT_TRUE(host.shown);
    EXPECT_EQ(static_cast<double>(host.used_cycles), used);
    EXPECT_EQ(static_cast<double>(host.video_frames), frames);
    EXPECT_EQ(static_cast<double>(host.slack_cycles), std::floor(kFramePs / 50'000) - used);
    EXPECT_EQ(host.slack_cycles<0, frames> 1);
    EXPECT_NEAR(host.slack_us, (kFramePs - used * 50'000) * 1e-6, 1e-5 * std::abs(host.slack_us) + 1e-9);
    EXPECT_NEAR(result.answer.update_rate_hz, result.answer.display_rate_hz / frames, 1e-6);
    // A frame's own is that of the update that came in with it; none came in between.
    double least = 1e9;
    for (const run::FrameFigures& frame : result.frames) {
      const bool came_in = frame.frame > 0 && frame.frame % host.video_frames == 0;
      EXPECT_EQ(frame.host_slack_us.has_value(), came_in) << frame.frame;
      if (frame.host_slack_us) least = std::min(least, *frame.host_slack_us);
    }
    EXPECT_NEAR(least, host.slack_us, 1e-5 * std::abs(host.slack_us));
  }
}

// A bus that takes a cycle more for each word leaves as many cycles less.
TEST_F(DeadlinesTest, OfTheHostsMovesWithTheBus) {
  const auto host = [&](const char* cycles) {
    return show(kTurning, {.set = {"video.columns=64", "video.lines=64", "host.computation_units=1",
                                   "host.processors_per_unit=1024", "host.sustained_mflops=6.0",
                                   std::string("host.bus_cycles_per_word=") + cycles},
                           .frames = 4,
                           .reference = false,
                           .pictures = false})
        .result;
  };
  const run::Result slow = host("3");
  const run::Result quick = host("2");
  const std::uint64_t shown = slow.deadlines.host.video_frames;  // the frame that the first update comes in with
  ASSERT_EQ(shown, quick.deadlines.host.video_frames);
  ASSERT_LT(shown, slow.frames.size());
  const std::uint64_t words = slow.frames[shown].words_sent;
  EXPECT_GT(words, 0U);
  const double cycles = (*quick.frames[shown].host_slack_us - *slow.frames[shown].host_slack_us) * 20.0;
  EXPECT_NEAR(cycles, static_cast<double>(words), 0.5);
}

// Where no update came in after the first picture, the next one is told; of a scene that stands still, that of moving
// everything.
TEST_F(DeadlinesTest, OfTheHostsIsTheBudgetsWhereNoneWasShown) {
  for (const std::string& scene : {kTurning, scene_of(kSphere)}) {
    const run::Result result = show(scene, {.set = {}, .reference = false, .pictures = false}).result;
    const run::Deadlines::Host& host = result.deadlines.host;
    EXPECT_FALSE(host.shown);
    EXPECT_EQ(host.video_frames, 1U);
    EXPECT_EQ(static_cast<double>(host.used_cycles), named(result.budgets, "host.update").used);
    EXPECT_EQ(static_cast<double>(host.used_cycles) + static_cast<double>(host.slack_cycles), 399'999);
  }
}

}  // namespace
}  // namespace rastertlm::test
