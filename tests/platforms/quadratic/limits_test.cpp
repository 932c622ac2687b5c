// Does the depth complexity that the report says a machine holds hold, and one step more not, whoever limits it? Do the
// units' cycles add up to what they did, and does every budget move with what it says moves it?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "src/run/drawing_limits.h"
#include "src/run/quadratic_budgets.h"
#include "src/run/quadratic_figures.h"
#include "tests/platforms/quadratic/screens.h"
#include "tests/platforms/quadratic/sphere_frames.h"
#include "tests/support/forked.h"

namespace rastertlm::test {
namespace {

constexpr double kSide = 128;
constexpr double kStrip = 8;  // lines
constexpr int kPlaces = 16;   // of strips on the screen

// `count` strips of 8 lines across the screen, from its top on and again; each nearer than what is there, or, where
// `every_second_hidden`, of each two one that is seen and one behind it.
scene::Scene strips(int count, bool every_second_hidden = false) {
  scene::Scene scene = screen_scene(kSide);
  for (int i = 0; i < count; ++i) {
    const int place = every_second_hidden ? i / 2 : i;
    const double nearer = (every_second_hidden && i % 2 == 1 ? -0.5 : 0.0) + place;
    const double first = kStrip * (place % kPlaces);
    add_rectangle(scene, kSide, kSide, first, first + kStrip, nearer);
  }
  return scene;
}

// Drawn in 20 ms, shown at retraces.
quadratic::Machine at_retraces() {
  quadratic::Machine machine = span_unit_alone(128, 128);
  machine.frame_store.swap = frame_store::Swap::retrace;
  machine.frame_store.clear = true;
  machine.frame_store.access_ns = 1.0;
  return machine;
}

struct Outcome {
  double rate = 0.0;
  double screens = 0.0;  // that it holds
  std::string who;       // the budget, and the unit that limits
};

Outcome outcome_of(const quadratic::Machine& machine, const scene::Scene& scene) {
  constexpr std::uint64_t kFrames = 10;
  const std::string text = in_child([&] {
    quadratic::Quadratic platform(machine, scene, {kFrames, false}, {});
    platform.run();
    const run::WorstFrame worst = run::worst_frame(platform);
    const std::vector<run::Budget> budgets = run::quadratic_budgets(platform);
    const auto found =
        std::find_if(budgets.begin(), budgets.end(), [](const run::Budget& b) { return b.name == "depth_complexity"; });
    std::ostringstream out;
    out.precision(12);
    out << platform.frames_per_second() << ' ' << found->available << ' ' << worst.least().name << ": "
        << worst.least().unit;
    return out.str();
  });
  Outcome outcome;
  std::istringstream in(text);
  in >> outcome.rate >> outcome.screens;
  std::getline(in >> std::ws, outcome.who);
  return outcome;
}

struct Limited {
  quadratic::Machine machine;
  std::string who;
  bool every_second_hidden = false;
};

// What the machine is said to hold when it draws few strips, and what it does with as many as that and a step more.
void expect_limit(const Limited& limited) {
  const int step = limited.every_second_hidden ? 2 : 1;
  const auto with = [&](int count) { return outcome_of(limited.machine, strips(count, limited.every_second_hidden)); };
  const Outcome few = with(10);
  EXPECT_EQ(few.who, limited.who);
  EXPECT_NEAR(few.rate, 50.0, 0.01);
  const double most = few.screens * kPlaces / step;
  // Far enough from a whole step that the ends of a frame do not matter.
  ASSERT_GT(most - std::floor(most), 0.2) << most;
  ASSERT_LT(most - std::floor(most), 0.8) << most;
  const int held = static_cast<int>(std::floor(most)) * step;
  ASSERT_GT(held, 12);
  EXPECT_NEAR(with(held).rate, 50.0, 0.01) << held << " strips of " << most * step;
  EXPECT_LT(with(held + step).rate, 49.0) << held + step << " strips of " << most * step;
}

TEST(DepthComplexity, BySpanUnit) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 950.0;
  expect_limit({machine, "span_unit: span unit"});
}

// 16,384 words to clear, and 2,048 accesses a strip, all of which wins.
TEST(DepthComplexity, ByMemory) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 5.0;
  machine.frame_store.access_ns = 340.0;
  expect_limit({machine, "drawing: frame store"});
}

// The screen is read through the same port.
TEST(DepthComplexity, ByMemoryThatTheScreenShares) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 5.0;
  machine.frame_store.access_ns = 266.0;
  machine.frame_store.scan_out = frame_store::ScanOut::shared;
  Outcome few = outcome_of(machine, strips(10));
  EXPECT_TRUE(few.who.ends_with(": frame store")) << few.who;
  expect_limit({machine, few.who});
}

// Hidden pixels are read, which is quicker than a pixel of the unit; those that win are written as well, which is
// slower: neither alone is in the way.
TEST(DepthComplexity, BySpanUnitAndMemoryInTurn) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 500.0;
  machine.frame_store.access_ns = 300.0;
  expect_limit({machine, "drawing: span unit", true});
}

TEST(DepthComplexity, BySetUp) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 5.0;
  machine.host.sustained_mflops = 1.3;
  expect_limit({machine, "set_up: set-up processor"});
}

TEST(DepthComplexity, ByBus) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 5.0;
  machine.host.clock_hz = 100'000'000;
  machine.host.bus_cycles_per_word = 1'200;
  expect_limit({machine, "set_up: bus"});
}

// Without shadow sets a triangle's words wait for the last pixel.
TEST(DepthComplexity, ByBusAndSpanUnitInTurn) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 475.0;
  machine.host.clock_hz = 100'000'000;
  machine.host.bus_cycles_per_word = 600;
  machine.span_unit.shadow_sets = 0;
  expect_limit({machine, "drawing: span unit"});
}

// One buffer that waits for the screen is shown in every second frame, however little is drawn.
TEST(DepthComplexity, OfOneBufferIsNone) {
  quadratic::Machine machine = at_retraces();
  machine.frame_store.buffers = 1;
  const Outcome outcome = outcome_of(machine, strips(1));
  EXPECT_EQ(outcome.screens, 0.0);
  EXPECT_NEAR(outcome.rate, 25.0, 0.01);
  EXPECT_TRUE(outcome.who.ends_with(": frame store")) << outcome.who;  // as the headline says
}

// What each unit did, from what was drawn.
TEST(Units, SayWhereTheirCyclesWent) {
  quadratic::Machine machine = at_retraces();
  machine.span_unit.clock_ns = 50.0;
  machine.frame_store.access_ns = 10.0;
  machine.host.clock_hz = 100'000'000;
  machine.host.sustained_mflops = 50.0;
  machine.host.bus_cycles_per_word = 3;
  const scene::Scene scene = strips(10);
  quadratic::Quadratic platform(machine, scene, {3, false}, {});
  platform.run();
  std::map<std::string, run::UnitFigures> units;
  for (const run::UnitFigures& unit : run::unit_figures(platform)) units[unit.name] = unit;
  ASSERT_EQ(units.size(), 5U);
  const std::uint64_t end = platform.end_ps();
  EXPECT_EQ(end, 3 * std::uint64_t{20'000'000'000});  // three retraces at 50 Hz
  for (const auto& [name, unit] : units) {
    EXPECT_EQ(unit.busy + unit.starved + unit.blocked + unit.idle, unit.cycles) << name;
    EXPECT_NEAR(static_cast<double>(unit.cycles) / unit.clock_hz, 1e-12 * static_cast<double>(end), 1e-7) << name;
    EXPECT_FALSE(unit.clock.empty()) << name;
  }
  const std::uint64_t pixels = 3 * 10 * 1024;
  EXPECT_EQ(platform.span_unit().counters().pixels, pixels);
  EXPECT_EQ(units["frame store"].busy, 3U * 128 * 128 + 2 * pixels);
  EXPECT_EQ(units["bus"].busy, 3 * platform.set_up_processor().words_sent());
  EXPECT_EQ(units["bus"].busy + units["bus"].starved, units["set-up processor"].busy);
  EXPECT_EQ(units["bus"].blocked, units["set-up processor"].blocked);
  EXPECT_EQ(units["scan-out"].busy, 2U * 128 * 128);  // of three screens the first had nothing to show
  EXPECT_EQ(units["scan-out"].starved, 1U * 128 * 128);
  EXPECT_EQ(platform.links().back().bytes(), 2U * 128 * 128 * 3);
  EXPECT_EQ(platform.span_unit().words_loaded(), platform.set_up_processor().words_sent());
}

// Every budget by its name: used and available.
using Figures = std::map<std::string, std::pair<double, double>>;

struct Described {
  Figures figures;
  std::map<std::string, std::string> moved_by;
};

Described budgets_with(std::vector<std::string> settings) {
  settings.insert(settings.begin(), {"video.columns=64", "video.lines=64"});
  const std::string text = in_child([&] {
    const run::Inputs inputs = sphere_inputs("168", settings);
    const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
    quadratic::Quadratic platform(machine, *inputs.content->scene, {3, false}, {});
    platform.run();
    std::ostringstream out;
    out.precision(17);
    for (const run::Budget& b : run::quadratic_budgets(platform))
      out << b.name << '\n' << b.used << ' ' << b.available << '\n' << b.moved_by << '\n';
    return out.str();
  });
  Described described;
  std::istringstream in(text);
  std::string name, numbers, moved_by;
  while (std::getline(in, name) && std::getline(in, numbers) && std::getline(in, moved_by)) {
    std::istringstream(numbers) >> described.figures[name].first >> described.figures[name].second;
    described.moved_by[name] = moved_by;
  }
  return described;
}

std::vector<std::string> parts(const std::string& list) {
  std::vector<std::string> all;
  std::istringstream in(list);
  for (std::string part; std::getline(in >> std::ws, part, ',');) all.push_back(part);
  return all;
}

TEST(Budgets, MoveWithWhatTheySay) {
  const std::map<std::string, std::string> changes{
      {"host.sustained_mflops", "10.0"},  {"host.bus_cycles_per_word", "3"}, {"host.bus_bits", "16"},
      {"host.clock_hz", "50000000"},      {"set_up.method", "gouraud"},      {"video.refresh_hz", "40.0"},
      {"span_unit.clock_ns", "62.5"},     {"span_unit.pixel_cycles", "2"},   {"span_unit.line_change_cycles", "3"},
      {"span_unit.load_cycles", "7"},     {"span_unit.units", "2"},          {"span_unit.shadow_sets", "400"},
      {"span_unit.fraction_bits", "18"},  {"frame_store.access_ns", "35.0"}, {"frame_store.width_bits", "96"},
      {"frame_store.banks", "2"},         {"frame_store.clear", "false"},    {"frame_store.depth_test", "false"},
      {"frame_store.scan_out", "shared"}, {"frame_store.buffers", "1"},      {"video.columns", "72"}};
  const Described before = budgets_with({});
  std::map<std::string, Figures> after;
  for (const auto& [path, value] : changes)
    after[path] = budgets_with({std::string(path).append(1, '=').append(value)}).figures;
  EXPECT_GT(before.figures.size(), 14U);
  for (const auto& [name, figures] : before.figures)
    for (const std::string& path : parts(before.moved_by.at(name))) {
      const std::string table = path.ends_with(".*") ? path.substr(0, path.size() - 1) : "";
      bool moves = false;
      for (const auto& [changed, with] : after)
        if (changed == path || (!table.empty() && changed.starts_with(table)))
          moves = moves || with.count(name) == 0 || with.at(name) != figures;
      EXPECT_TRUE(moves) << name << " does not move with " << path;
    }
}

}  // namespace
}  // namespace rastertlm::test
