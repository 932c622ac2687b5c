// Budgets, memories and cycles of quadric processors, each worked out here from the machine's numbers, and each moved
// by its parameter.
#include <fmt/format.h>

#include "tests/platforms/imogene/quadric_numbers.h"
#include "tests/platforms/imogene/simulation.h"
#include "tests/platforms/imogene/solid_scenes.h"

namespace rastertlm::test {
namespace {

using Machine = QuadricNumbers;

class QuadricBudgetTest : public SimulationTest {
 protected:
  run::Result result(const Machine& machine, const std::vector<std::string>& more = {},
                     std::uint64_t frames = 2) const {
    std::vector<std::string> set = machine.set();
    set.insert(set.end(), more.begin(), more.end());
    return simulate(kQuadricMachine, written("scene.toml", SolidScene(71, SolidScene::View::perspective).text()),
                    {.set = set, .frames = frames, .reference = false, .pictures = false})
        .result;
  }
};

void expect_budget(const run::Result& result, const std::string& name, double used, double available) {
  const run::Budget& budget = named(result.budgets, name);
  EXPECT_DOUBLE_EQ(budget.used, used) << name;
  EXPECT_DOUBLE_EQ(budget.available, available) << name;
  EXPECT_EQ(budget.fits, used <= available) << name;
}

// An accumulator of n slices: the RAM's output and the sum, a carry between two slices, and the registers that hold
// back what comes too early: of slice i those of n - 1 - i clocks.
std::uint64_t accumulator(std::uint64_t bits, std::uint64_t slice) {
  const std::uint64_t n = (bits + slice - 1) / slice;
  return 2 * bits + (n - 1) + slice * (n * (n - 1) / 2);
}

void expect_memories(const run::Result& result, const Machine& m) {
  const std::uint64_t processors = m.units * m.quadrics;
  const auto words = [&](const std::string& name, std::uint64_t count, std::uint64_t bits, std::uint64_t kept) {
    for (const char* ram : {"loading", "backup"}) {
      const std::string full = fmt::format("quadric {} RAMs: {}", ram, name);
      if (count > 0) {
        EXPECT_EQ(named(result.memories, full).total_bits(), processors * count * bits) << full;
      }
    }
    const std::string again = "quadric backup RAMs: " + name + ", kept";
    if (kept > 0 && m.kept)
      EXPECT_EQ(named(result.memories, again).total_bits(), processors * kept * bits) << again;
    else
      EXPECT_THROW(named(result.memories, again), std::runtime_error) << again;
  };
  words("discriminant", 6, m.word, 3);                             // V0, Dy and D0 are replaced line by line
  words("depth and caps", 3 * (1 + m.caps), m.plane, 1 + m.caps);  // C of each
  words("normal", 9, 24, 3);
  words("normal of root", 3, m.factor, 0);
  words("normals of caps", 3 * m.caps, 24, 0);
  words("control", 1, 4 + 2 + 6 + 2 * m.caps, 0);  // material, part, shift, what is kept at each cap

  const std::uint64_t accumulators =
      2 * accumulator(m.word, m.slice) + (1 + m.caps) * accumulator(m.plane, m.slice) + 3 * accumulator(24, 12);
  const std::uint64_t registers = named(result.memories, "quadric processor registers").bits_per_word;
  EXPECT_EQ(registers, accumulators + m.pipeline_bits());
  EXPECT_EQ(named(result.memories, "quadric processor registers").total_bits(), processors * registers);
  if (m.delay)
    EXPECT_EQ(named(result.memories, "delay of triangles' fragments").total_bits(), m.units * m.latency() * m.link());
  else
    EXPECT_THROW(named(result.memories, "delay of triangles' fragments"), std::runtime_error);
}

void expect_logic(const run::Result& result, const Machine& m) {
  const std::uint64_t processors = m.units * m.quadrics;
  const std::uint64_t stages = m.root_bits();
  // Two accumulators of the EP2, one of each plane and of each component of the normal; a subtracter a stage; the two
  // depths; behind the rows of the normal.
  const std::uint64_t adders = 2 * m.slices(m.word) + (1 + m.caps) * m.slices(m.plane) + 3 * 2 + m.root_clocks() +
                               2 * m.slices(m.plane) + 3 * m.slices(m.joined());
  EXPECT_EQ(named(result.logic, "quadric processors: adder slices").count, processors * adders);
  std::uint64_t bits = 2 * m.word + (1 + m.caps) * m.plane + 3 * 24 + 2 * m.plane + 3 * m.joined();
  bits += stages * (stages + 1) / 2 + 2 * stages;  // stage i subtracts from a remainder of i + 2 bits
  EXPECT_EQ(named(result.logic, "quadric processors: adder width").count, processors * bits);
  EXPECT_EQ(named(result.logic, "quadric processors: multipliers of root and constant").count, 3 * processors);
  std::uint64_t rows = 0;  // each a bit shorter than the one before
  for (std::uint64_t row = 0; row < m.read_bits(); ++row) rows += m.normal_word() - row;
  EXPECT_EQ(named(result.logic, "quadric processors: carry-save rows of these").count, 3 * processors * rows);
  // Every cap in two trees; five of entry, exit and roots; and depth on the link.
  EXPECT_EQ(named(result.logic, "quadric processors: comparators").count, processors * (2 * m.caps + 5 + 1));
  // Normals of 24 bits are shifted by up to 24 - 1 - (normal - 1): as many shifters of 1, 2, 4, .. as that has bits.
  std::uint64_t shifters = 0;
  while ((24 - m.normal) >> shifters != 0) ++shifters;
  EXPECT_EQ(named(result.logic, "quadric processors: shifters").count,
            processors * (3 * shifters + (m.scaled ? 1 : 0)));
  EXPECT_EQ(named(result.logic, "quadric processor: stages of the root").count, stages);
  EXPECT_EQ(named(result.logic, "quadric processor: root").count, m.root_clocks());
  EXPECT_EQ(named(result.logic, "quadric processor: depth, until all is compared").count, m.depth_clocks());
  EXPECT_EQ(named(result.logic, "quadric processor: normal, root included").count, m.normal_clocks());
  EXPECT_EQ(named(result.logic, "quadric processor: later than a triangle").count, m.latency());
  std::uint64_t levels = 0;
  while ((1ULL << levels) < m.units * (m.triangles + m.quadrics)) ++levels;
  EXPECT_EQ(named(result.logic, "pixel to level: latency").count, 1 + (m.delay ? m.latency() : 0) + levels + 10);
  EXPECT_EQ(named(result.logic, "decision unit: depth comparators").count, m.units * (m.triangles + m.quadrics) - 1);
}

void expect_units(const run::Result& result, const Machine& m, std::uint64_t frames) {
  std::uint64_t starts = 0;
  for (std::uint64_t line = 0; line < m.lines; ++line)
    starts += line < m.fields ? m.first_line_start(line) : m.line_start(m.fields);
  for (std::uint64_t board = 0; board < m.units; ++board) {
    const run::UnitFigures& unit = named(result.units, fmt::format("quadric board {}", board));
    EXPECT_EQ(unit.cycles, frames * m.fields * kFrame);
    EXPECT_EQ(unit.busy, frames * (m.fields * 14 + starts + m.lines * m.columns));
    EXPECT_EQ(unit.busy + unit.starved + unit.blocked + unit.idle, unit.cycles);
    const run::LinkFigures& link = named(result.links, fmt::format("quadric board {} to decision unit", board));
    EXPECT_EQ(link.bits, m.link());
    EXPECT_EQ(link.bytes, frames * m.lines * m.columns * m.link() / 8);
  }
}

// What is left of a line: of the first of a retrace, whose programs begin early, behind the copy.
void expect_deadlines(const run::Result& result, const Machine& m) {
  const std::uint64_t blanking = m.line() - m.columns;
  const std::uint64_t retrace = kFrame - m.line() * (m.lines / m.fields);
  for (std::uint64_t line = 0; line < m.lines; ++line) {
    const std::uint64_t left = line < m.fields
                                   ? retrace + blanking - 14 - m.first_line_start(line) - (m.delay ? 0 : m.latency())
                                   : blanking - m.line_start(m.fields);
    EXPECT_EQ(result.deadlines.lines.slack_cycles.at(line), static_cast<std::int64_t>(left)) << line;
  }
  // The copy, and the first line's early start.
  const std::uint64_t boards = 14 + (m.delay ? 0 : m.latency());
  EXPECT_EQ(result.deadlines.retrace.boards_cycles, boards);
  EXPECT_EQ(result.deadlines.retrace.slack_cycles, static_cast<std::int64_t>(retrace - boards));
}

void expect_all(const run::Result& result, const Machine& m, std::uint64_t frames = 2) {
  expect_budget(result, "quadrics", SolidScene::kSolids, static_cast<double>(m.units * m.quadrics));
  expect_budget(result, "quadric_line_start", static_cast<double>(m.line_start(m.fields)),
                static_cast<double>(m.line() - m.columns));
  // 4 ns a bit of the widest slice of each.
  const auto delay = [&](const char* name, std::uint64_t bits) {
    expect_budget(result, name, 4.0 * static_cast<double>(std::min(m.slice, bits)), 60.0);
  };
  delay("quadric_adder_delay", std::max(m.word, m.plane));
  delay("quadric_root_delay", m.root_bits() + 2);
  delay("quadric_sum_delay", m.plane);
  delay("quadric_multiplier_delay", std::max(m.read_bits(), m.joined()));
  const std::uint64_t lines_of_field = m.lines / m.fields;
  const auto retrace = static_cast<double>(kFrame - m.line() * lines_of_field);
  const double boards = 14.0 + (m.delay ? 0.0 : static_cast<double>(m.latency()));
  expect_budget(result, "frame_start", boards, retrace);
  expect_budget(result, "pipeline_skew", boards, retrace);  // a tree
  expect_memories(result, m);
  expect_logic(result, m);
  expect_units(result, m, frames);
  expect_deadlines(result, m);
}

TEST_F(QuadricBudgetTest, AreThoseOfTheMachineFile) { expect_all(result({}), {}); }

TEST_F(QuadricBudgetTest, EachParameterMovesItsOwn) {
  const std::vector<std::pair<const char*, std::function<void(Machine&)>>> changes{
      {"units", [](Machine& m) { m.units = 5; }},
      {"quadrics", [](Machine& m) { m.quadrics = 3; }},
      {"word", [](Machine& m) { m.word = 57; }},
      {"plane", [](Machine& m) { m.plane = 45; }},
      {"narrow slices", [](Machine& m) { m.slice = 7; }},
      {"wide slices", [](Machine& m) { m.slice = 60; }},
      {"caps", [](Machine& m) { m.caps = 2; }},
      {"no caps", [](Machine& m) { m.caps = 0; }},
      {"multiplier", [](Machine& m) { m.factor = 19; }},
      {"root",
       [](Machine& m) {
         m.root_integer = 12;
         m.root_guard = 3;
       }},
      {"a root that caps are later than",
       [](Machine& m) {
         m.root_integer = 2;
         m.root_guard = 0;
         m.slice = 7;
       }},
      {"a normal that is later than depth",
       [](Machine& m) {
         m.factor = 32;
         m.plane = 25;
         m.slice = 8;
         m.root_integer = 16;
         m.root_guard = 8;
       }},
      {"output", [](Machine& m) { m.output = 5; }},
      {"floor", [](Machine& m) { m.half_unit = false; }},
      {"fixed scale", [](Machine& m) { m.scaled = false; }},
      {"delay", [](Machine& m) { m.delay = true; }},
      {"short normals", [](Machine& m) { m.normal = 9; }},
      {"one copy", [](Machine& m) { m.kept = false; }},
      {"screen",
       [](Machine& m) {
         m.columns = 128;
         m.lines = 80;
       }},
      {"interlaced", [](Machine& m) { m.fields = 2; }}};
  for (const auto& [name, change] : changes) {
    SCOPED_TRACE(name);
    Machine machine;
    change(machine);
    const std::vector<std::string> fast{"host.sustained_mflops=50.0"};
    expect_all(result(machine, fast), machine);
  }
}

// The machine file's own all fit. Slices of 16 bits take 64 ns of 60 wherever something is as wide, of 15 bits 60.
TEST_F(QuadricBudgetTest, EachPartThatIsTooSlowSaysNo) {
  const std::vector<std::string> delays{"quadric_adder_delay", "quadric_root_delay", "quadric_sum_delay",
                                        "quadric_multiplier_delay"};
  const auto too_slow = [&](const run::Result& shown) {
    std::vector<std::string> names;
    for (const std::string& name : delays)
      if (!named(shown.budgets, name).fits) names.push_back(name);
    std::size_t limits = 0;
    for (const std::string& limit : shown.answer.limits) limits += limit.find("_delay needs") != std::string::npos;
    EXPECT_EQ(limits, names.size());
    EXPECT_EQ(shown.answer.display_works, names.empty());
    return names;
  };
  EXPECT_EQ(too_slow(result({})), std::vector<std::string>{});
  Machine m;
  m.slice = 16;
  EXPECT_EQ(too_slow(result(m)), delays);
  m.root_integer = 10;
  m.root_guard = 3;  // subtracters of 15 bits, 60 ns; 14 rows, but 26 bits behind them
  EXPECT_EQ(too_slow(result(m)), (std::vector<std::string>{delays[0], delays[2], delays[3]}));
  m.factor = 12;  // 14 bits behind the rows
  EXPECT_EQ(too_slow(result(m)), (std::vector<std::string>{delays[0], delays[2]}));
  m.root_guard = 4;
  EXPECT_EQ(too_slow(result(m)), (std::vector<std::string>{delays[0], delays[1], delays[2]}));
  m.slice = 15;
  EXPECT_EQ(too_slow(result(m)), std::vector<std::string>{});
}

// Adders of 48 bits take 192 ns, and the machine's clock is 60: what limits it is named.
TEST_F(QuadricBudgetTest, WhatLimitsIsNamed) {
  Machine wide;
  wide.slice = 48;
  const run::Result slow = result(wide);
  EXPECT_EQ(slow.answer.bottleneck.unit, "quadric processors");
  EXPECT_DOUBLE_EQ(slow.answer.bottleneck.utilisation, 192.0 / 60);
  EXPECT_FALSE(slow.answer.display_works);
  // The line start of words in slices of a bit, before pixels that leave it little time: 48 + 5 + 3 x 48 + 12 cycles
  // and 512 pixels of 631 - ... do not fit and are refused.
  Machine narrow;
  narrow.slice = 2;
  narrow.columns = narrow.lines = 512;
  EXPECT_EQ(narrow.line(), 631U);
  EXPECT_EQ(narrow.line_start(1), 113U);
  const run::Result busy = result(narrow, {"host.sustained_mflops=500.0", "host.link_mbit_per_s=1000.0"});
  EXPECT_EQ(busy.answer.bottleneck.unit, "quadric boards");
  const std::uint64_t cycles = 14 + narrow.first_line_start(0) + 511 * narrow.line_start(1) + 512 * 512;
  EXPECT_NEAR(busy.answer.bottleneck.utilisation, static_cast<double>(cycles) / kFrame, 1e-9);
  narrow.slice = 1;
  EXPECT_THROW(result(narrow), InputError);
}

// A discriminant of 16 bits in slices of two is soon begun, and depths of 48 bits are not: an EP1's line start of 2 x
// 24
// + 5 cycles is the longer one.
TEST_F(QuadricBudgetTest, TheLineStartIsThatOfTheSlowestOfAProcessor) {
  Machine m;
  m.word = 16;
  m.plane = 48;
  m.slice = 2;
  EXPECT_EQ(m.line_start(1), 8U + 5 + 3 * 8 + 12);
  const run::Result shallow = result(m, {"quadric_processor.fraction_bits=4"});
  EXPECT_DOUBLE_EQ(named(shallow.budgets, "quadric_line_start").used, 2 * 24 + 5);
  EXPECT_EQ(named(shallow.units, "quadric board 0").busy, 2 * (14 + 64 * 53 + 64 * 64));
}

// 1 / (62.5 Hz x 50 ns) are 320,000 clocks: 30 lines of 10,666, and 20 of retrace. The copy takes 14 of them, and
// quadrics begin their lines 29 before triangles do.
TEST_F(QuadricBudgetTest, AnEarlyStartFitsTheRetraceOrIsRefused) {
  const std::vector<std::string> bare{"video.refresh_hz=62.5", "video.pixel_clock_ns=50.0",
                                      "video.vertical_retrace_us=0.0"};
  Machine m;
  m.lines = 30;
  try {
    result(m, bare);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find(fmt::format("quadrics start their lines {} pixel clocks early, after a frame start of "
                                    "14, and the vertical retrace has 20",
                                    m.latency())),
              std::string::npos)
        << error.what();
  }
  m.delay = true;
  EXPECT_DOUBLE_EQ(named(result(m, bare).budgets, "frame_start").available, 20);
}

// Whole slots for what is drawn: 31 words and 9 for each cap; 13 to park what has left.
TEST_F(QuadricBudgetTest, WordsSentAreThoseOfSlots) {
  for (const std::uint64_t caps : {5U, 6U}) {
    Machine m;
    m.caps = caps;
    const run::Result all = result(m, {"host.sustained_mflops=50.0"}, 3);
    const std::uint64_t slot = 31 + 9 * caps;
    for (const run::FrameFigures& frame : all.frames)
      EXPECT_EQ(frame.words_sent, 10 * slot + 22 * SolidScene::kTriangles) << frame.frame;
  }
  // A ball that orbits out of view, and one that stays: the second is sent once.
  const std::string file =
      written("leaves.toml", scene_of("[[object]]\ntype = \"sphere\"\nradius = 0.5\nmaterial = \"glaze\"\ntranslate = "
                                      "[0.0, -3.0, 0.0]\n[[object.animation]]\ntype = \"orbit\"\naxis = [0.0, 0.0, "
                                      "1.0]\ndeg_per_frame = 60.0\n[[object]]\ntype = \"sphere\"\nradius = "
                                      "0.3\nmaterial = \"slate\"\n"));
  const std::vector<std::string> set{"video.columns=64", "video.lines=64", "host.sustained_mflops=50.0"};
  const run::Result moved = simulate(kQuadricMachine, file, {.set = set, .frames = 7, .reference = false}).result;
  constexpr std::uint64_t kSlot = 31 + 9 * 6;
  // At 0 and 180 degrees it is in the middle; 60 degrees aside it is 2.6 from it, more than the picture's half height
  // of tan 15 degrees x 8.5 = 2.28 and its own radius; beyond the middle 11.5, 3.08.
  std::vector<std::uint64_t> words;
  for (const run::FrameFigures& frame : moved.frames) words.push_back(frame.words_sent);
  EXPECT_EQ(words[0], 2 * kSlot);
  for (std::size_t k = 1; k < words.size(); ++k) {
    const bool drawn = moved.frames[k].solids_drawn == 2, before = moved.frames[k - 1].solids_drawn == 2;
    EXPECT_EQ(words[k], drawn ? kSlot : before ? 13U : 0U) << k;
  }
  const run::Result all =
      simulate(kQuadricMachine, file,
               {.set = {"video.columns=64", "video.lines=64", "host.sustained_mflops=50.0", "host.send=all"},
                .frames = 2,
                .reference = false})
          .result;
  EXPECT_EQ(all.frames[1].words_sent, moved.frames[1].words_sent + kSlot);
}

// Ten numbers of a matrix, four of each plane and a material, of four bytes each; 76 bytes a triangle.
TEST_F(QuadricBudgetTest, TheFirstLoadHasTheSolids) {
  std::uint64_t planes = 0;
  for (const int of_one : SolidScene::kPlanes) planes += static_cast<std::uint64_t>(of_one);
  EXPECT_EQ(result({}).answer.initial_load_bytes, 4 * (10 * 11 + 4 * planes) + 76 * SolidScene::kTriangles);
}

}  // namespace
}  // namespace rastertlm::test
