#include "modules/quadric_processor/quadric_board.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "modules/object_processor/line_composer.h"
#include "src/base/errors.h"
#include "tests/modules/quadric_processor/any_solid.h"

namespace rastertlm::quadric_processor {
namespace {

using test::any_bits;
using test::any_parameters;
using test::any_solid;
using test::drawn;
using test::kColumns;
using test::kLines;
using test::kScreen;

struct Shown {
  std::uint32_t depth = 0xFFFFFF;
  std::uint32_t object = 0;
  std::array<std::uint32_t, 3> normal{};
  std::uint32_t covered = 0;
};

// Every processor at a pixel, one after the other, by the logic of a pixel.
Shown stepped(const std::vector<QuadricWords>& solids, const QuadricParameters& parameters, std::uint32_t x,
              std::uint32_t y) {
  const QuadricPixelLogic logic(parameters, kScreen.depth_bits, kScreen.range);
  Shown shown;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const QuadricPixel pixel = logic(solids[i], pixel_words(solids[i], x, y, parameters, kScreen.depth_bits));
    if (!pixel.covered) continue;
    ++shown.covered;
    if (!(pixel.depth < shown.depth)) continue;
    shown.depth = pixel.depth;
    shown.object = static_cast<std::uint32_t>(i) + 1;
    shown.normal = pixel.normal;
  }
  return shown;
}

void board_shows_what_is_stepped(const std::vector<QuadricWords>& solids, const QuadricParameters& parameters,
                                 Visit visit, VectorVariant variant) {
  QuadricBoard board(parameters, kScreen, static_cast<std::uint32_t>(solids.size()), 0, visit, variant);
  for (std::uint32_t i = 0; i < solids.size(); ++i) board.write(i, solids[i]);
  board.copy();
  object_processor::ObjectProcessorParameters triangles;
  object_processor::LineComposer composer(triangles, kColumns, true, variant);
  const object_processor::Prenormaliser normalise(triangles);
  frame::FragmentLine out;
  out.resize(kColumns);
  std::uint64_t fragments = 0;
  std::uint64_t kept = 0;
  for (std::uint32_t y = 0; y < kLines; ++y) {
    const frame::CoveredLine* covered = nullptr;
    board.cover_lines(y, 1, 1, &covered);
    const std::uint64_t seen = composer.compose({&covered, 1}, y, out);
    std::uint64_t expected_seen = 0;
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const Shown expected = stepped(solids, parameters, x, y);
      fragments += expected.covered;
      expected_seen += expected.object != 0 ? 1 : 0;
      if (out.empty()) {
        RC_ASSERT(expected.object == 0U);
        continue;
      }
      RC_ASSERT(out.object[x] == expected.object);
      RC_ASSERT(out.coverage[x] == expected.covered);
      RC_ASSERT(out.depth[x] == expected.depth);
      if (expected.object == 0) continue;
      RC_ASSERT(out.material[x] == solids[expected.object - 1].material);
      const auto link = normalise(expected.normal);
      RC_ASSERT(out.normal_x[x] == link[0]);
      RC_ASSERT(out.normal_y[x] == link[1]);
      RC_ASSERT(out.normal_z[x] == link[2]);
    }
    RC_ASSERT(seen == expected_seen);
    RC_ASSERT(covered->seen_pixels == expected_seen);
    kept += seen;
  }
  RC_ASSERT(board.counters().fragments_in == fragments);
  RC_ASSERT(board.counters().fragments_kept == kept);
  RC_ASSERT(board.counters().fragments_hidden == fragments - kept);
}

std::vector<VectorVariant> variants() {
  std::vector<VectorVariant> known{VectorVariant::baseline};
  if (__builtin_cpu_supports("avx2") != 0) known.push_back(VectorVariant::avx2);
  if (vector_variant() == VectorVariant::avx512) known.push_back(VectorVariant::avx512);
  return known;
}

RC_GTEST_PROP(QuadricBoardTest, ShowsWhatEveryPixelsLogicShows, ()) {
  const QuadricParameters parameters = any_parameters();
  std::vector<QuadricWords> solids;
  for (int i = drawn(1, 4); i > 0; --i) solids.push_back(any_solid(parameters));
  const auto visit = *rc::gen::element(Visit::needed, Visit::everything);
  board_shows_what_is_stepped(solids, parameters, visit, *rc::gen::elementOf(variants()));
}

RC_GTEST_PROP(QuadricBoardTest, ShowsItAlsoWhereWordsWrap, ()) {
  const QuadricParameters parameters = any_parameters();
  std::vector<QuadricWords> solids;
  for (int i = drawn(1, 4); i > 0; --i) solids.push_back(any_bits(parameters));
  board_shows_what_is_stepped(solids, parameters, Visit::needed, *rc::gen::elementOf(variants()));
}

// The region is what saves time: a solid in a corner is looked at in that corner alone.
TEST(QuadricBoardTest, LooksAtNoLineThatASolidDoesNotTouch) {
  QuadricParameters parameters;
  parameters.per_unit = 1;
  QuadricBoard board(parameters, kScreen, 1, 0);
  QuadricWords sphere;  // about (20, 30), of 10 pixels
  const double unit = std::ldexp(1.0, static_cast<int>(parameters.fraction_bits));
  const auto word = [&](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value * unit)) & low_mask(48);
  };
  sphere.discriminant = {word(100 - 400 - 900), word(-1 + 60), word(-2), word(-1 + 40), word(0), word(-2)};
  sphere.middle = {0, 0, 1 << 23};
  sphere.root_shift = 8;
  board.write(0, sphere);
  board.copy();
  const Interval lines = board.lines_of_processor(0);
  EXPECT_GE(lines.begin, 18);
  EXPECT_LE(lines.end, 43);
  EXPECT_TRUE(lines.holds(20) && lines.holds(40));
  std::uint64_t columns = 0;
  for (std::uint32_t y = 0; y < kLines; ++y) {
    const frame::CoveredLine* covered = nullptr;
    board.cover_lines(y, 1, 1, &covered);
    for (std::size_t i = 0; i < covered->solid_count; ++i) columns += covered->solids[i].end - covered->solids[i].begin;
  }
  EXPECT_GE(board.counters().fragments_in, 305U);                    // of about 314
  EXPECT_LE(columns, board.counters().fragments_in + (4 + 7) * 21);  // from a multiple of eight
  EXPECT_LE(board.counters().lines_evaluated, 25U);
}

// What a line has shown stays while slots that were never written are.
TEST(QuadricBoardTest, SpansStayWhereTheyAreWhileSlotsAreAdded) {
  QuadricParameters parameters;
  QuadricBoard board(parameters, kScreen, 1000, 0);
  QuadricWords everywhere;
  everywhere.discriminant.v0 = 1 << 20;
  everywhere.middle.c = 1 << 23;
  everywhere.material = 7;
  board.write(0, everywhere);
  board.copy();
  const frame::CoveredLine* covered = nullptr;
  board.cover_lines(0, 1, 1, &covered);
  ASSERT_EQ(covered->solid_count, 1U);
  const frame::SolidSource* source = covered->solids[0].source;
  board.write(999, everywhere);
  board.cover_lines(0, 1, 1, &covered);
  EXPECT_EQ(covered->solids[0].source, source);
  EXPECT_EQ(source->middle.material, 7U);
  EXPECT_EQ(source->middle.object, 1U);
}

TEST(QuadricBoardTest, ParkedAndUnknownSlots) {
  QuadricParameters parameters;
  parameters.caps = 1;
  QuadricBoard board(parameters, kScreen, 2, 5);
  board.write(1, parked_quadric(48));
  EXPECT_EQ(board.copy(), 1U);
  EXPECT_EQ(board.slots_in_use(), 0U);
  const std::array<std::uint32_t, 2> words{1, 2};
  EXPECT_THROW(board.write_words(2, 0, words), ModelError);
  EXPECT_THROW(board.write_words(0, words_of_slot(1) - 1, words), ModelError);
  const frame::CoveredLine* covered = nullptr;
  EXPECT_THROW(board.cover_lines(kLines, 1, 1, &covered), ModelError);
}

}  // namespace
}  // namespace rastertlm::quadric_processor
