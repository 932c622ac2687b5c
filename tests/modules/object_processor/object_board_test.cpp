// Does a board show on every line what its processors, stepped one by one by the microprogram, would show?
#include "modules/object_processor/object_board.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "modules/object_processor/elementary_processor.h"
#include "src/base/errors.h"

namespace rastertlm::object_processor {
namespace {

struct Machine {
  ObjectProcessorParameters parameters;
  std::uint32_t first_processor = 0;
  std::uint32_t columns = 1;
  std::uint32_t lines = 1;
  std::vector<TriangleWords> triangles;  // one a slot
};

struct Pixel {
  std::uint32_t depth = 0;
  std::array<std::uint32_t, 3> normal{};
  std::uint32_t material = 0;
  std::uint32_t object = 0;
  std::uint32_t coverage = 0;
};

// Every elementary processor stepped through the whole frame; every processor looked at on every pixel, in the order of
// numbers.
std::vector<Pixel> stepped_picture(const Machine& machine) {
  const auto bits = static_cast<unsigned>(machine.parameters.word_bits);
  const unsigned slices = machine.parameters.slices();
  std::vector<Pixel> picture(std::size_t{machine.columns} * machine.lines);
  for (Pixel& pixel : picture) pixel.depth = static_cast<std::uint32_t>(low_mask(bits));
  for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot) {
    const ProcessorWords words = to_words(machine.triangles[slot]);
    std::vector<ElementaryProcessor> processors(kElementaryProcessors, ElementaryProcessor(machine.parameters));
    for (std::size_t index = 0; index < kCoefficients; ++index)
      processors[index / 3].write_loading(static_cast<unsigned>(index % 3), words[index]);
    for (auto& processor : processors) processor.run(frame_start_program());
    for (std::uint32_t line = 0; line < machine.lines; ++line) {
      for (auto& processor : processors) processor.run(line_start_program(slices));
      for (std::uint32_t column = 0; column < machine.columns; ++column) {
        Pixel& pixel = picture[std::size_t{line} * machine.columns + column];
        const auto negative = [&](std::size_t edge) { return (processors[edge].output() >> (bits - 1)) != 0; };
        if (!negative(0) && !negative(1) && !negative(2)) {
          ++pixel.coverage;
          const std::uint32_t depth = processors[kDepth].output();
          if (depth < pixel.depth)
            pixel = {depth,
                     {processors[4].output(), processors[5].output(), processors[6].output()},
                     machine.triangles[slot].material,
                     machine.first_processor + slot + 1,
                     pixel.coverage};
        }
        for (auto& processor : processors) processor.step(pixel_instruction(slices));
      }
    }
  }
  return picture;
}

ObjectBoard loaded_board(const Machine& machine, Visit visit = Visit::needed) {
  ObjectBoard board(machine.parameters, static_cast<std::uint32_t>(machine.triangles.size()), machine.first_processor,
                    machine.columns, machine.lines, visit);
  for (std::uint32_t slot = 0; slot < machine.triangles.size(); ++slot) board.write(slot, machine.triangles[slot]);
  board.copy();
  return board;
}

void compare_line(const Machine& machine, const std::vector<Pixel>& picture, std::uint32_t line,
                  const frame::FragmentLine& out) {
  const Prenormaliser prenormalise(machine.parameters);
  for (std::uint32_t column = 0; column < machine.columns; ++column) {
    const Pixel& wanted = picture[std::size_t{line} * machine.columns + column];
    if (column < out.begin || column >= out.end) {
      RC_ASSERT(wanted.coverage == 0U);
      continue;
    }
    RC_ASSERT(out.depth[column] == wanted.depth);
    RC_ASSERT(out.object[column] == wanted.object);
    RC_ASSERT(out.coverage[column] == wanted.coverage);
    if (wanted.object == 0) continue;
    const LinkNormal normal = prenormalise(wanted.normal);
    RC_ASSERT(out.normal_x[column] == normal[0]);
    RC_ASSERT(out.normal_y[column] == normal[1]);
    RC_ASSERT(out.normal_z[column] == normal[2]);
    RC_ASSERT(out.material[column] == wanted.material);
  }
}

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

class Source {
 public:
  explicit Source(std::uint32_t seed) : random_(seed) {}
  std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_()) % limit; }
  std::int64_t within(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint32_t>(high - low + 1)));
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }

  // A triangle through three points near the screen; with `stretch` bits of scale that make its words wrap or not.
  std::array<LinearWords, 3> edges(const Machine& machine) {
    std::array<std::array<std::int64_t, 2>, 3> p{};
    for (auto& point : p)
      point = {within(-10, machine.columns + 10), within(-10, static_cast<std::int64_t>(machine.lines) + 10)};
    const std::int64_t area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    const std::int64_t scale = (area < 0 ? -1 : 1) * (std::int64_t{1} << below(12));
    std::array<LinearWords, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = p[i];
      const auto& to = p[(i + 1) % 3];
      const std::int64_t a = scale * (from[1] - to[1]);
      const std::int64_t b = scale * (to[0] - from[0]);
      result[i] = linear(a, b, -(a * from[0] + b * from[1]) - b);
    }
    return result;
  }
  static LinearWords linear(std::int64_t a, std::int64_t b, std::int64_t c) {
    return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
  }

  TriangleWords triangle(const Machine& machine) {
    const auto bits = static_cast<unsigned>(machine.parameters.word_bits);
    if (below(8) == 0) return parked_triangle(bits);
    TriangleWords result;
    result.edges = edges(machine);
    if (below(4) == 0)
      for (LinearWords& edge : result.edges)
        if (below(2) == 0) edge = {word(), word(), word()};
    // Few depths, so that ties are frequent; some planes slope and wrap.
    result.depth = {0, 0, below(4) << (bits - 3)};
    if (below(3) == 0) result.depth = {word(), word(), word()};
    if (below(9) == 0) result.depth = {0, 0, static_cast<std::uint32_t>(low_mask(bits))};
    if (below(3) == 0) result.depth.a = 1;
    for (LinearWords& normal : result.normals) normal = {word() >> below(32), word() >> below(32), word() >> below(32)};
    result.material = below(16);
    return result;
  }

  Machine machine(CarryClock clock) {
    struct Widths {
      std::int64_t word, slice, normal;
    };
    constexpr Widths kWidths[] = {{24, 12, 12}, {24, 24, 12}, {24, 8, 12}, {16, 4, 9}, {32, 16, 16}, {28, 14, 12}};
    const Widths widths = kWidths[below(6)];
    Machine machine;
    machine.parameters.word_bits = widths.word;
    machine.parameters.slice_bits = widths.slice;
    machine.parameters.normal_bits = widths.normal;
    machine.parameters.carry_clock = clock;
    machine.first_processor = below(1000);
    machine.columns = 1 + below(40);
    machine.lines = 1 + below(24);
    const auto mask = static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(widths.word)));
    machine.triangles.resize(1 + below(12));
    for (TriangleWords& slot : machine.triangles) {
      ProcessorWords words = to_words(triangle(machine));
      for (std::size_t index = 0; index < kCoefficients; ++index) words[index] &= mask;
      slot = to_triangle(words);
    }
    return machine;
  }

 private:
  std::mt19937 random_;
};

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

TEST(ObjectBoard, MemoryIsAFewHundredBytesASlot) {
  ObjectBoard board({}, 4096, 0, 512, 512);
  for (std::uint32_t slot = 0; slot < 4096; ++slot) board.write(slot, full_screen(slot, 0));
  board.copy();
  EXPECT_LT(board.memory_bytes(), 4096U * 300U);
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
