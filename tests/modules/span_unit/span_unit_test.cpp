// Does the span unit show what its registers step through, in every width, start edge and variant, and count its
// clocks?
#include "modules/span_unit/span_unit.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "modules/span_unit/span_registers.h"
#include "src/base/fixed_point.h"
#include "tests/support/figure_7.h"
#include "tests/support/span_pixels.h"

namespace rastertlm::span_unit {
namespace {

class SpanUnitTest : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{11};
  std::int64_t number(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  EdgeWords edge(std::int64_t low, std::int64_t high) {
    EdgeWords words;
    words.column = number(low, high);
    words.step = number(-5, 5);
    words.divisor = number(1, 1000);
    words.rest = number(0, words.divisor - 1);
    words.rest_step = number(0, words.divisor - 1);
    return words;
  }
  TriangleLoad load(std::int64_t lines) {
    TriangleLoad load;
    load.count = static_cast<std::size_t>(number(1, 2));
    load.second_goes_on = number(0, 1) == 1;
    load.halves[0].lines = number(1, lines / 2);
    load.halves[1].first_line = load.halves[0].lines;
    load.halves[1].lines = number(1, lines / 2);
    for (HalfTriangle& half : load.halves) {
      half.start = edge(-20, 40);
      half.end = edge(30, 90);
      for (std::size_t c = 0; c < kChannels; ++c)
        put_words({random_(), random_(), random_(), random_(), random_(), random_()}, c, half.registers);
      put_words({random_(), random_(), random_(), 0, 0, 0}, kDepthSet, half.registers);
    }
    return load;
  }
};

struct Pixel {
  std::uint32_t levels = 0;
  std::uint32_t depth = 0;
  bool shown = false;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

constexpr std::uint32_t kColumns = 70;
constexpr std::uint32_t kLines = 40;
using Picture = std::vector<Pixel>;

struct Drawn {
  Picture picture = Picture(std::size_t{kColumns} * kLines);
  std::uint64_t cycles = 0;
};

Drawn drawn_by_unit(const SpanUnitParameters& parameters, const TriangleLoad& load,
                    VectorVariant variant = VectorVariant::baseline) {
  Drawn drawn;
  SpanUnit unit(parameters, kColumns, kLines, variant);
  const DrawnLines lines = unit.draw(load);
  std::uint64_t cycles = 0;
  std::uint64_t shown = 0;
  for (const Span& span : lines.spans) {
    cycles += span.cycles;
    shown += span.count;
    const test::SpanPixels pixels = test::pixels_of(span, pixel_format(parameters));
    for (std::uint32_t x = 0; x < span.count; ++x)
      drawn.picture[std::size_t{span.line} * kColumns + span.column + x] = {pixels.levels[x], pixels.depths[x], true};
  }
  EXPECT_EQ(lines.cycles, cycles);
  EXPECT_EQ(lines.pixels, shown);
  EXPECT_EQ(unit.counters().pixels, shown);
  EXPECT_EQ(unit.counters().lines, lines.spans.size());
  drawn.cycles = cycles;
  return drawn;
}

// floor(a b / 2^down) of a word of 40 bits at most and a fraction of 17.
std::int64_t product(std::int64_t a, std::int64_t b, unsigned down) {
  return floor_div(a * b, std::int64_t{1} << down);
}

// From the edge to the first pixel, f in `bits`, to nearest: I += f (dI - T5 (1 - f)), dI += 2 T5 f, products floored;
// dI and 2 T5 as signed words.
void prestep(ColourRegisters& registers, std::uint64_t pixel_pixel, unsigned word, const EdgeWords& edge,
             unsigned bits) {
  const std::int64_t one = std::int64_t{1} << bits;
  const std::int64_t f = (2 * edge.rest * one + edge.divisor) / (2 * edge.divisor);
  const std::int64_t second = sign_extend(pixel_pixel, word);
  const std::int64_t slope = sign_extend(registers.di(), word) - product(second, one - f, bits + 1);
  registers.set_line(registers.i() + static_cast<std::uint64_t>(product(slope, f, bits)),
                     registers.di() + static_cast<std::uint64_t>(product(second, f, bits)));
}

// Clock by clock: figure 6, three sets and a linear one.
Drawn drawn_by_registers(const SpanUnitParameters& parameters, const TriangleLoad& load) {
  Drawn drawn;
  const auto word_bits = static_cast<unsigned>(parameters.word_bits);
  const auto fraction = static_cast<unsigned>(parameters.fraction_bits);
  std::vector<ColourRegisters> colour(3, ColourRegisters(word_bits));
  ColourRegisters depth(static_cast<unsigned>(parameters.depth_bits + parameters.depth_fraction_bits));
  const bool lattice = parameters.start_edge == StartEdge::lattice;
  std::array<std::uint64_t, 3> pixel_pixel{};
  EdgeWords start;
  EdgeWords end;
  for (std::size_t h = 0; h < load.count; ++h) {
    const HalfTriangle& half = load.halves[h];
    const bool loads = h == 0 || !load.second_goes_on;
    for (std::int64_t k = 0; k < half.lines; ++k) {
      bool carries = false;
      if (k == 0 && loads) {
        for (std::size_t c = 0; c < 3; ++c) {
          colour[c].load(words_of(half.registers, c));
          pixel_pixel[c] = half.registers.pixel_pixel[c];
        }
        depth.load(words_of(half.registers, kDepthSet));
        start = half.start;
      } else {
        carries = start.advance();
        for (ColourRegisters& c : colour) c.step_line(carries && lattice);
        depth.step_line(carries && lattice);
      }
      if (k == 0 && (h == 0 || load.second_goes_on))
        end = half.end;
      else
        end.advance();
      if (parameters.start_edge == StartEdge::prestep) {
        const auto bits = static_cast<unsigned>(parameters.prestep_bits);
        for (std::size_t c = 0; c < 3; ++c) prestep(colour[c], pixel_pixel[c], word_bits, start, bits);
        prestep(depth, 0, static_cast<unsigned>(parameters.depth_bits + parameters.depth_fraction_bits), start, bits);
      }
      std::uint64_t cycles = 0;
      for (std::int64_t x = start.column; x < std::min<std::int64_t>(end.column, kColumns); ++x) {
        if (x >= 0) {
          Pixel& pixel = drawn.picture[static_cast<std::size_t>((half.first_line + k) * kColumns + x)];
          pixel = {0, static_cast<std::uint32_t>(depth.i() >> parameters.depth_fraction_bits), true};
          for (std::size_t c = 0; c < 3; ++c) pixel.levels |= level_of(colour[c].i(), word_bits, fraction) << (8 * c);
        }
        for (ColourRegisters& c : colour) c.step_pixel();
        depth.step_pixel();
        ++cycles;
      }
      drawn.cycles += std::max<std::uint64_t>(cycles, 1);
      if (carries && lattice && parameters.carry == Carry::clock) ++drawn.cycles;
    }
  }
  return drawn;
}

TEST_P(SpanUnitTest, ShowsWhatTheRegistersStepThrough) {
  std::size_t shown = 0;
  for (const std::int64_t word : {18, 32, 33, 40})
    for (const StartEdge start : {StartEdge::lattice, StartEdge::published, StartEdge::prestep})
      for (const Carry carry : {Carry::rank, Carry::clock})
        for (int round = 0; round < 40; ++round) {
          SpanUnitParameters parameters;
          parameters.word_bits = word;
          parameters.fraction_bits = word - kIntegerBits;
          parameters.depth_bits = number(8, 24);
          parameters.depth_fraction_bits = number(0, 8);
          parameters.start_edge = start;
          parameters.carry = carry;
          parameters.prestep_bits = number(1, 16);
          const TriangleLoad triangle = load(kLines);
          const Drawn by_unit = drawn_by_unit(parameters, triangle, GetParam());
          const Drawn by_registers = drawn_by_registers(parameters, triangle);
          ASSERT_EQ(by_unit.picture, by_registers.picture);
          ASSERT_EQ(by_unit.cycles, by_registers.cycles);
          for (const Pixel& pixel : by_unit.picture) shown += pixel.shown ? 1 : 0;
        }
  EXPECT_GT(shown, 150'000U);
}

// Figure 7 through what draws pictures: its start edge's registers are what the lines begin with, its pixels what they
// go on with. Alone, where lines are drawn in one go, and beside another unit, where they are crossed one by one.
TEST_P(SpanUnitTest, DrawsFigure7) {
  const std::vector<test::Figure7Row> rows = test::figure_7();
  ASSERT_EQ(rows.size(), 10U);
  for (const std::int64_t units : {1, 2}) {
    SpanUnitParameters parameters;
    parameters.units = units;
    SpanUnit unit(parameters, kColumns, kLines, GetParam());
    const DrawnLines drawn = unit.draw(test::figure_7_load());
    ASSERT_EQ(drawn.spans.size(), 4U);
    EXPECT_EQ(drawn.pixels, rows.size());
    ColourRegisters registers(32);
    for (const test::Figure7Row& row : rows) {
      const Span& span = drawn.spans[row.line];
      ASSERT_EQ(span.line, row.line);
      ASSERT_LT(row.pixel, span.count);
      if (row.pixel == 0)
        registers.load({span.i[1], 0, span.di[1], 0, 0, span.pixel_pixel[1]});
      else
        registers.step_pixel();
      EXPECT_EQ(registers.i(), row.i) << "clock " << row.clock;
      EXPECT_EQ(registers.di(), row.di) << "clock " << row.clock;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, SpanUnitTest, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

TEST(SpanUnit, SharedColumnsEndALineTogether) {
  TriangleLoad load;
  load.count = 1;
  load.halves[0].lines = 1;
  load.halves[0].start.column = 3;
  load.halves[0].end.column = 20;  // 17 pixels
  const std::uint64_t expected[] = {17, 9, 6, 5};
  for (std::int64_t units = 1; units <= 4; ++units) {
    SpanUnitParameters parameters;
    parameters.units = units;
    EXPECT_EQ(drawn_by_unit(parameters, load).cycles, expected[units - 1]);
    parameters.pixel_cycles = 3;
    EXPECT_EQ(drawn_by_unit(parameters, load).cycles, 3 * expected[units - 1]);
    parameters.share = Share::triangles;
    EXPECT_EQ(drawn_by_unit(parameters, load).cycles, 51U);
  }
}

TEST(SpanUnitParameters, AreRefusedWhereWordsDoNotHoldThem) {
  SpanUnitParameters parameters;
  parameters.fraction_bits = 23;
  parameters.depth_bits = 30;
  Diagnostics diagnostics;
  parameters.check("machine.toml", diagnostics);
  ASSERT_EQ(diagnostics.list().size(), 2U);
  EXPECT_EQ(diagnostics.list()[0].key, "span_unit.fraction_bits");
  EXPECT_NE(diagnostics.list()[0].message.find("at most 22"), std::string::npos);
  EXPECT_EQ(diagnostics.list()[1].key, "span_unit.depth_fraction_bits");
  Diagnostics none;
  SpanUnitParameters{}.check("machine.toml", none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace rastertlm::span_unit
