// Do spans, compared and resolved by every vector kernel that this processor has, show and count what comparing pixel
// by pixel does?
#include "modules/object_processor/line_composer.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "tests/modules/object_processor/board_machines.h"

namespace rastertlm::object_processor {
namespace {

void compare_counters(const BoardCounters& spans, const BoardCounters& pixels) {
  RC_ASSERT(spans.fragments_in == pixels.fragments_in);
  RC_ASSERT(spans.fragments_kept == pixels.fragments_kept);
  RC_ASSERT(spans.fragments_hidden == pixels.fragments_hidden);
  RC_ASSERT(spans.lines_evaluated == pixels.lines_evaluated);
  RC_ASSERT(spans.processors_visited == pixels.processors_visited);
  RC_ASSERT(spans.pixels_stepped == pixels.pixels_stepped);
}

// The machine's triangles dealt to boards in a row.
std::vector<Machine> boards_of(const Machine& machine, Source& source) {
  std::vector<Machine> boards;
  for (std::size_t first = 0; first < machine.triangles.size();) {
    const std::size_t count = std::min<std::size_t>(1 + source.below(5), machine.triangles.size() - first);
    Machine& board = boards.emplace_back(machine);
    board.first_processor += static_cast<std::uint32_t>(first);
    const auto begin = machine.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    board.triangles.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    first += count;
  }
  return boards;
}

// Every line of the machine, in the order that the boards are asked for them.
void compare_lines(const Machine& machine, VectorVariant variant, Source& source, Visit visit) {
  const std::vector<Pixel> picture = stepped_picture(machine);
  std::vector<ObjectBoard> in_spans;
  std::vector<ObjectBoard> in_pixels;
  for (const Machine& board : boards_of(machine, source)) {
    in_spans.push_back(loaded_board(board, visit, variant));
    in_pixels.push_back(loaded_board(board, visit, VectorVariant::baseline));
  }
  LineComposer composer(machine.parameters, machine.columns, true, variant);
  frame::FragmentLine out;
  out.resize(machine.columns);
  frame::FragmentLine alone;
  alone.resize(machine.columns);
  const std::uint32_t stride = source.below(3) == 0 ? 5 : 1;
  for (std::uint32_t line = 0; line < machine.lines; line += stride) {
    std::vector<const frame::CoveredLine*> covered;
    covered.reserve(in_spans.size());
    for (ObjectBoard& board : in_spans) covered.push_back(&board.cover_line(line));
    std::uint64_t wanted = 0;
    for (std::uint32_t column = 0; column < machine.columns; ++column)
      wanted += picture[std::size_t{line} * machine.columns + column].object != 0 ? 1 : 0;
    RC_ASSERT(composer.compose(covered, line, out) == wanted);
    compare_line(machine, picture, line, out);
    for (std::size_t k = 0; k < in_pixels.size(); ++k) {
      alone.clear();
      const std::uint64_t before = in_pixels[k].counters().fragments_kept;
      in_pixels[k].evaluate_line(line, alone);
      RC_ASSERT(covered[k]->seen_pixels == in_pixels[k].counters().fragments_kept - before);
    }
  }
  for (std::size_t k = 0; k < in_pixels.size(); ++k) compare_counters(in_spans[k].counters(), in_pixels[k].counters());
}

RC_GTEST_PROP(LineComposer, ShowsAndCountsWhatPixelsDo, (std::uint32_t seed)) {
  Source source(seed);
  const Machine machine = source.machine(CarryClock::clock1);
  for (const VectorVariant variant : available_vector_variants())
    for (const Visit visit : {Visit::needed, Visit::everything}) compare_lines(machine, variant, source, visit);
}

// Whole triangles on screens wider than a register, without a word that wraps: the closed forms alone.
RC_GTEST_PROP(LineComposer, WideScreens, (std::uint32_t seed)) {
  Source source(seed);
  Machine machine;
  machine.columns = 480 + source.below(100);
  machine.lines = 3 + source.below(20);
  machine.triangles.resize(1 + source.below(30));
  for (TriangleWords& slot : machine.triangles) {
    slot = source.triangle(machine);
    slot.edges = source.edges(machine);
    ProcessorWords words = to_words(slot);
    for (std::size_t index = 0; index < kCoefficients; ++index) words[index] &= 0xFFFFFF;
    slot = to_triangle(words);
  }
  for (const VectorVariant variant : available_vector_variants())
    compare_lines(machine, variant, source, Visit::needed);
}

// More objects on a line than marks fit beside a depth word.
TEST(LineComposer, ManyObjectsOnALine) {
  constexpr std::uint32_t kObjects = 700;
  constexpr std::uint32_t kColumns = 40;
  for (const VectorVariant variant : available_vector_variants()) {
    ObjectBoard board({}, kObjects, 0, kColumns, 1, Visit::needed, variant);
    // Object k covers everything; nearer ones come later, but for the last hundred.
    for (std::uint32_t slot = 0; slot < kObjects; ++slot) {
      TriangleWords triangle;
      triangle.depth.c = slot < 600 ? 10'000 - slot : 20'000;
      triangle.material = slot % 16;
      board.write(slot, triangle);
    }
    board.copy();
    LineComposer composer({}, kColumns, true, variant);
    frame::FragmentLine out;
    out.resize(kColumns);
    const frame::CoveredLine* covered = &board.cover_line(0);
    EXPECT_EQ(composer.compose({&covered, 1}, 0, out), kColumns);
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      EXPECT_EQ(out.object[column], 600U) << name_of(variant);
      EXPECT_EQ(out.depth[column], 10'000U - 599U);
      EXPECT_EQ(out.material[column], 599U % 16);
      EXPECT_EQ(out.coverage[column], kObjects);
    }
    EXPECT_EQ(board.counters().fragments_in, std::uint64_t{kObjects} * kColumns);
    EXPECT_EQ(board.counters().fragments_kept, kColumns);
  }
}

TEST(LineComposer, WithoutObserversLevelsNeedNoDepth) {
  ObjectBoard board({}, 1, 0, 16, 1);
  TriangleWords triangle;
  triangle.depth.c = 77;
  triangle.normals[2].c = 1U << 22;
  board.write(0, triangle);
  board.copy();
  for (const bool observe : {true, false}) {
    LineComposer composer({}, 16, observe);
    frame::FragmentLine out;
    out.resize(16);
    std::fill(out.depth.begin(), out.depth.end(), 5U);
    const frame::CoveredLine* covered = &board.cover_line(0);
    composer.compose({&covered, 1}, 0, out);
    EXPECT_EQ(out.depth[3], observe ? 77U : 5U);
    EXPECT_EQ(out.object[3], 1U);
    EXPECT_EQ(out.normal_z[3], 1U << 10);
  }
}

}  // namespace
}  // namespace rastertlm::object_processor
