// Does a board show on every line what its processors, stepped one by one by the microprogram, would show?
#include "modules/object_processor/object_board.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "src/base/errors.h"
#include "tests/modules/object_processor/board_machines.h"

namespace rastertlm::object_processor {
namespace {

void compare_picture(const Machine& machine, ObjectBoard& board) {
  const std::vector<Pixel> picture = stepped_picture(machine);
  frame::FragmentLine out;
  out.resize(machine.columns);
  for (std::uint32_t line = 0; line < machine.lines; ++line) {
    out.clear();
    board.evaluate_line(line, out);
    compare_line(machine, picture, line, out);
  }
  const BoardCounters& counters = board.counters();
  RC_ASSERT(counters.fragments_in == counters.fragments_kept + counters.fragments_hidden);
  std::uint64_t covered = 0;
  std::uint64_t seen = 0;
  for (const Pixel& pixel : picture) {
    covered += pixel.coverage;
    seen += pixel.object != 0 ? 1 : 0;
  }
  RC_ASSERT(counters.fragments_in == covered);
  RC_ASSERT(counters.fragments_kept == seen);
}

RC_GTEST_PROP(ObjectBoard, ShowsWhatSteppedProcessorsShow, (std::uint32_t seed)) {
  const Machine machine = Source(seed).machine(CarryClock::clock1);
  ObjectBoard board = loaded_board(machine);
  compare_picture(machine, board);
}

RC_GTEST_PROP(ObjectBoard, ShowsTheWrongPictureOfTheLateCarry, (std::uint32_t seed)) {
  const Machine machine = Source(seed).machine(CarryClock::clock2);
  ObjectBoard board = loaded_board(machine);
  compare_picture(machine, board);
}

RC_GTEST_PROP(ObjectBoard, ModellingEverythingChangesNothing, (std::uint32_t seed)) {
  const Machine machine = Source(seed).machine(CarryClock::clock1);
  ObjectBoard board = loaded_board(machine, Visit::everything);
  compare_picture(machine, board);
  RC_ASSERT(board.counters().processors_visited == std::uint64_t{machine.lines} * machine.triangles.size());
}

// Two boards in a chain, the second working on the line of the first, are one board of all processors.
RC_GTEST_PROP(ObjectBoard, ContinuesALineOfLowerProcessors, (std::uint32_t seed)) {
  Source source(seed);
  const Machine machine = source.machine(CarryClock::clock1);
  Machine first = machine;
  Machine second = machine;
  const auto split =
      static_cast<std::ptrdiff_t>(source.below(static_cast<std::uint32_t>(machine.triangles.size()) + 1));
  first.triangles.assign(machine.triangles.begin(), machine.triangles.begin() + split);
  second.triangles.assign(machine.triangles.begin() + split, machine.triangles.end());
  second.first_processor += static_cast<std::uint32_t>(split);
  ObjectBoard first_board = loaded_board(first);
  ObjectBoard second_board = loaded_board(second);
  const std::vector<Pixel> picture = stepped_picture(machine);
  frame::FragmentLine out;
  out.resize(machine.columns);
  for (std::uint32_t line = 0; line < machine.lines; ++line) {
    out.clear();
    first_board.evaluate_line(line, out);
    second_board.evaluate_line(line, out);
    compare_line(machine, picture, line, out);
  }
}

// Later frames, in any order of lines: what was overwritten is shown after the copy and not before.
RC_GTEST_PROP(ObjectBoard, FollowsChangesAndJumps, (std::uint32_t seed)) {
  Source source(seed);
  Machine machine = source.machine(CarryClock::clock1);
  ObjectBoard board = loaded_board(machine);
  frame::FragmentLine out;
  out.resize(machine.columns);
  for (int frame = 0; frame < 3; ++frame) {
    const std::vector<Pixel> picture = stepped_picture(machine);
    for (int jump = 0; jump < 10; ++jump) {
      const std::uint32_t line = source.below(machine.lines);
      for (std::uint32_t next = line; next < std::min(line + 3, machine.lines); ++next) {
        out.clear();
        board.evaluate_line(next, out);
        compare_line(machine, picture, next, out);
      }
      const std::uint32_t slot = source.below(static_cast<std::uint32_t>(machine.triangles.size()));
      const std::uint32_t other = source.below(static_cast<std::uint32_t>(machine.triangles.size()));
      board.write(slot, machine.triangles[other]);
    }
    for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot) machine.triangles[slot] = board.loading(slot);
    board.copy();
    for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot)
      RC_ASSERT(board.backup(slot) == machine.triangles[slot]);
  }
}

// The even lines, then the odd ones, as interlaced video takes them; and every third, whose steps pass whole triangles.
RC_GTEST_PROP(ObjectBoard, TakesLinesInFields, (std::uint32_t seed)) {
  Source source(seed);
  const Machine machine = source.machine(CarryClock::clock1);
  ObjectBoard in_order = loaded_board(machine);
  frame::FragmentLine out;
  out.resize(machine.columns);
  for (std::uint32_t line = 0; line < machine.lines; ++line) in_order.evaluate_line(line, out);
  const std::vector<Pixel> picture = stepped_picture(machine);
  for (const std::uint32_t fields : {2U, 3U}) {
    ObjectBoard board = loaded_board(machine);
    for (std::uint32_t field = 0; field < fields; ++field)
      for (std::uint32_t line = field; line < machine.lines; line += fields) {
        out.clear();
        board.evaluate_line(line, out);
        compare_line(machine, picture, line, out);
      }
    RC_ASSERT(board.counters().processors_visited == in_order.counters().processors_visited);
    RC_ASSERT(board.counters().lines_evaluated == in_order.counters().lines_evaluated);
  }
}

// A whole-screen triangle: edges that are 0 everywhere.
TriangleWords full_screen(std::uint32_t depth, std::uint32_t material) {
  TriangleWords triangle;
  triangle.depth.c = depth;
  triangle.material = material;
  return triangle;
}

TEST(ObjectBoard, StartsParkedAndTakesNoTime) {
  ObjectBoard board({}, 1'000'000, 0, 64, 64);
  EXPECT_EQ(board.copy(), 0U);
  frame::FragmentLine out;
  out.resize(64);
  for (std::uint32_t line = 0; line < 64; ++line) board.evaluate_line(line, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(board.counters().processors_visited, 0U);
  EXPECT_LT(board.memory_bytes(), 10'000U);
  EXPECT_EQ(board.backup(999'999), parked_triangle(24));
}

// And four a band of eight lines that it can touch.
TEST(ObjectBoard, MemoryIsAFewHundredBytesASlot) {
  ObjectBoard tall({}, 4096, 0, 512, 512);
  for (std::uint32_t slot = 0; slot < 4096; ++slot) tall.write(slot, full_screen(slot, 0));
  tall.copy();
  EXPECT_LT(tall.memory_bytes(), 4096U * (300U + 64U * 4U));
  ObjectBoard low({}, 4096, 0, 512, 8);
  for (std::uint32_t slot = 0; slot < 4096; ++slot) low.write(slot, full_screen(slot, 0));
  low.copy();
  EXPECT_LT(low.memory_bytes(), 4096U * (300U + 4U));
}

TEST(ObjectBoard, VisitsOnlyTheLinesOfATriangle) {
  ObjectBoard board({}, 8, 0, 64, 64);
  TriangleWords triangle = full_screen(5, 1);
  triangle.edges[0] = {0, 1, static_cast<std::uint32_t>(-11) & 0xFFFFFF};  // y >= 10
  triangle.edges[1] = {0, 0xFFFFFF, 21};                                   // y <= 20
  board.write(3, triangle);
  EXPECT_EQ(board.copy(), 1U);
  EXPECT_EQ(board.lines_of_processor(3), (Interval{10, 21}));
  EXPECT_EQ(board.slots_in_use(), 1U);
  frame::FragmentLine out;
  out.resize(64);
  for (std::uint32_t line = 0; line < 64; ++line) board.evaluate_line(line, out);
  EXPECT_EQ(board.counters().lines_evaluated, 11U);
  EXPECT_EQ(board.counters().fragments_in, 11U * 64U);
  EXPECT_EQ(board.counters().pixels_stepped, 0U);
  board.park(3);
  board.copy();
  EXPECT_EQ(board.slots_in_use(), 0U);
}

TEST(ObjectBoard, EqualDepthKeepsTheLowerNumberAndObjectsAreObserved) {
  ObjectBoard board({}, 3, 100, 16, 1);
  board.write(2, full_screen(7, 2));
  board.write(1, full_screen(7, 1));
  board.set_object(1, 42);
  board.copy();
  frame::FragmentLine out;
  out.resize(16);
  board.evaluate_line(0, out);
  EXPECT_EQ(out.object[5], 42U);
  EXPECT_EQ(out.material[5], 1U);
  EXPECT_EQ(out.coverage[5], 2U);
  EXPECT_EQ(board.object_of_processor(2), 103U);
}

TEST(ObjectBoard, RefusesAddressesThatDoNotExist) {
  ObjectBoard board({}, 3, 0, 16, 16);
  EXPECT_THROW(board.write_word(3, 0, 0), ModelError);
  EXPECT_THROW(board.write_word(0, kWords, 0), ModelError);
  frame::FragmentLine out;
  out.resize(16);
  EXPECT_THROW(board.evaluate_line(16, out), ModelError);
  out.resize(8);
  EXPECT_THROW(board.evaluate_line(0, out), ModelError);
}

}  // namespace
}  // namespace rastertlm::object_processor
