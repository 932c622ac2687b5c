// Does the nearest stay, in any order and vector variant, and is nothing else touched?
#include "modules/frame_store/frame_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "modules/span_unit/span_unit.h"
#include "tests/support/figure_7.h"
#include "tests/support/span_pixels.h"

namespace rastertlm::frame_store {
namespace {

constexpr std::uint32_t kColumns = 141;
constexpr std::uint32_t kLines = 7;

struct Drawn {
  span_unit::Span span;
  std::uint32_t object = 0;
  std::vector<std::uint32_t> levels, depths;  // as its registers step through them
};

class FrameStoreTest : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{21};
  std::uint32_t number(std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution<std::uint32_t>(low, high)(random_);
  }
  // Colours at random; depths from a few words, so that many are equal.
  std::vector<Drawn> spans(std::uint32_t count, const span_unit::PixelFormat& format = {}) {
    std::vector<Drawn> all;
    for (std::uint32_t i = 0; i < count; ++i) {
      Drawn d;
      d.object = i + 1;
      d.span.line = number(0, kLines - 1);
      d.span.column = number(0, kColumns - 1);
      d.span.count = number(1, kColumns - d.span.column);
      for (std::size_t c = 0; c < span_unit::kDepthSet; ++c) {
        d.span.i[c] = random_();
        d.span.di[c] = random_() >> number(0, 40);
        d.span.pixel_pixel[c] = random_() >> number(0, 60);
      }
      d.span.i[span_unit::kDepthSet] = std::uint64_t{number(0, 30)} << format.depth_fraction_bits;
      d.span.di[span_unit::kDepthSet] = number(0, 1) == 0 ? 0 : std::uint64_t{number(0, 9)} - 3;
      test::SpanPixels pixels = test::pixels_of(d.span, format);
      d.levels = std::move(pixels.levels);
      d.depths = std::move(pixels.depths);
      all.push_back(std::move(d));
    }
    return all;
  }
};

FrameStore::Format format() {
  FrameStore::Format format;
  format.columns = kColumns;
  format.lines = kLines;
  format.farthest = 0xFFFFFF;
  format.background = {1, 2, 3};
  format.ties = true;
  return format;
}

TEST_P(FrameStoreTest, KeepsTheNearestInAnyOrder) {
  for (const bool test : {true, false}) {
    FrameStoreParameters parameters;
    parameters.depth_test = test;
    std::vector<Drawn> drawn = spans(300);
    // A painter, pixel by pixel.
    std::vector<std::uint32_t> depth(kColumns * kLines, 0xFFFFFF), object(depth.size(), 0),
        levels(depth.size(), 0x030201), coverage(depth.size(), 0);
    for (const Drawn& d : drawn)
      for (std::uint32_t x = 0; x < d.span.count; ++x) {
        const std::size_t at = d.span.line * kColumns + d.span.column + x;
        ++coverage[at];
        if (test && d.depths[x] >= depth[at]) continue;
        depth[at] = d.depths[x];
        object[at] = d.object;
        levels[at] = d.levels[x];
      }
    if (test) std::shuffle(drawn.begin(), drawn.end(), random_);
    FrameStore store(parameters, format(), GetParam());
    store.clear();
    std::uint64_t kept = 0;
    std::uint64_t in = 0;
    for (const Drawn& d : drawn) {
      kept += store.draw({&d.span, 1}, d.object, d.object % 5);
      in += d.span.count;
    }
    store.swap();
    frame::Frame shown;
    store.observe(shown);
    EXPECT_EQ(shown.depth, depth);
    EXPECT_EQ(shown.object, object);
    EXPECT_EQ(shown.coverage, coverage);
    frame::RgbLine rgb;
    rgb.resize(kColumns);
    for (std::uint32_t line = 0; line < kLines; ++line) {
      store.scan_out(line, rgb);
      for (std::uint32_t x = 0; x < kColumns; ++x) {
        const std::uint32_t word = levels[line * kColumns + x];
        ASSERT_EQ(rgb.levels[3 * x], word & 0xFF);
        ASSERT_EQ(rgb.levels[3 * x + 1], word >> 8 & 0xFF);
        ASSERT_EQ(rgb.levels[3 * x + 2], word >> 16);
        ASSERT_EQ(shown.material[line * kColumns + x], object[line * kColumns + x] % 5);
      }
    }
    EXPECT_EQ(store.counters().fragments_in, in);
    EXPECT_EQ(store.counters().fragments_kept, kept);
    EXPECT_EQ(store.counters().fragments_hidden, in - kept);
  }
}

// Without numbers in the machine's store the first of equal depths stays, whoever observes what else.
TEST_P(FrameStoreTest, KeepsTheFirstOfEqualDepthsWithoutNumbers) {
  std::vector<Drawn> drawn = spans(300);
  std::shuffle(drawn.begin(), drawn.end(), random_);
  std::vector<std::uint64_t> kept;
  for (const FrameStore::Keep keep : {FrameStore::Keep::nothing, FrameStore::Keep::everything}) {
    FrameStore::Format with = format();
    with.ties = false;
    with.keep = keep;
    FrameStore store({}, with, GetParam());
    store.clear();
    std::vector<std::uint32_t> depth(kColumns * kLines, 0xFFFFFF), levels(depth.size(), 0x030201);
    for (const Drawn& d : drawn) {
      store.draw({&d.span, 1}, d.object, 0);
      for (std::uint32_t x = 0; x < d.span.count; ++x) {
        const std::size_t at = d.span.line * kColumns + d.span.column + x;
        if (d.depths[x] >= depth[at]) continue;
        depth[at] = d.depths[x];
        levels[at] = d.levels[x];
      }
    }
    store.swap();
    frame::RgbLine rgb;
    rgb.resize(kColumns);
    for (std::uint32_t line = 0; line < kLines; ++line) {
      store.scan_out(line, rgb);
      for (std::uint32_t x = 0; x < kColumns; ++x)
        ASSERT_EQ(rgb.levels[3 * x] | rgb.levels[3 * x + 1] << 8 | rgb.levels[3 * x + 2] << 16,
                  levels[line * kColumns + x]);
    }
    kept.push_back(store.counters().fragments_kept);
  }
  EXPECT_EQ(kept[0], kept[1]);
}

// Figure 7 as it is stored: eight bits of I at a time, with the sign above them, from wherever they are read.
TEST_P(FrameStoreTest, ShowsFigure7) {
  span_unit::SpanUnit unit(span_unit::SpanUnitParameters{}, kColumns, kLines, GetParam());
  const span_unit::TriangleLoad load = test::figure_7_load();
  for (const unsigned from : {0U, 4U, 8U, 12U, 16U, 20U, 23U}) {
    FrameStore::Format of = format();
    of.pixels.word_bits = from + 9;
    of.pixels.fraction_bits = from;
    FrameStore store({}, of, GetParam());
    store.clear();
    store.draw(unit.draw(load).spans, load.object, 0);
    store.swap();
    frame::RgbLine rgb;
    rgb.resize(kColumns);
    for (const test::Figure7Row& row : test::figure_7()) {
      const std::uint64_t read = row.i >> from;
      const std::uint64_t level = (read & 0x100) != 0 ? 0 : read & 0xFF;
      store.scan_out(row.line, rgb);
      for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_EQ(rgb.levels[3 * row.pixel + channel], level) << "clock " << row.clock << ", bits from " << from;
    }
  }
}

// One pixel after the other, in the order in which they come.
TEST_P(FrameStoreTest, SaysWhichPixelsWon) {
  for (const bool test : {true, false}) {
    FrameStoreParameters parameters;
    parameters.depth_test = test;
    FrameStore store(parameters, format(), GetParam());
    std::vector<std::uint32_t> depth(kColumns * kLines, 0xFFFFFF), object(depth.size(), 0);
    std::vector<Drawn> drawn = spans(300);
    std::shuffle(drawn.begin(), drawn.end(), random_);
    for (const Drawn& d : drawn) {
      std::vector<std::uint64_t> won(kColumns / 64 + 1, 0xFACE);
      store.draw({&d.span, 1}, d.object, 0, won.data());
      for (std::uint32_t x = 0; x < d.span.count; ++x) {
        const std::size_t at = d.span.line * kColumns + d.span.column + x;
        const bool wins = !test || d.depths[x] < depth[at] || (d.depths[x] == depth[at] && d.object < object[at]);
        ASSERT_EQ((won[x / 64] >> x % 64 & 1) != 0, wins) << x;
        if (wins) depth[at] = d.depths[x];
        if (wins) object[at] = d.object;
      }
    }
  }
}

// What is drawn over the last picture but one, where nothing clears it, needs both.
TEST_P(FrameStoreTest, ShowsOneBufferWhileTheOtherIsDrawn) {
  const std::vector<Drawn> drawn = spans(2);
  FrameStoreParameters parameters;
  parameters.clear = false;
  FrameStore store(parameters, format(), GetParam());
  const auto shows = [&](const Drawn& d) {
    frame::Frame shown;
    store.observe(shown);
    return shown.object[d.span.line * kColumns + d.span.column];
  };
  store.draw({&drawn[0].span, 1}, 1, 0);
  store.swap();
  store.draw({&drawn[1].span, 1}, 2, 0);
  EXPECT_EQ(shows(drawn[0]), 1U);
  EXPECT_NE(shows(drawn[1]), 2U);
  store.swap();
  EXPECT_EQ(shows(drawn[1]), 2U);
}

// Each picture begins with nothing, and so do lines of it that nothing is drawn into.
TEST_P(FrameStoreTest, BeginsEachPictureWithNothing) {
  for (const std::int64_t buffers : {1, 2}) {
    FrameStoreParameters parameters;
    parameters.buffers = buffers;
    FrameStore store(parameters, format(), GetParam());
    for (const Drawn& d : spans(20)) {
      store.clear();
      store.draw({&d.span, 1}, d.object, 0);
      store.swap();
      frame::Frame shown;
      store.observe(shown);
      frame::RgbLine rgb;
      rgb.resize(kColumns);
      for (std::uint32_t line = 0; line < kLines; ++line) {
        store.scan_out(line, rgb);
        for (std::uint32_t x = 0; x < kColumns; ++x) {
          const bool in = line == d.span.line && x >= d.span.column && x < d.span.column + d.span.count;
          const std::size_t at = line * kColumns + x;
          ASSERT_EQ(shown.object[at], in ? d.object : 0U);
          ASSERT_EQ(shown.depth[at], in ? d.depths[x - d.span.column] : 0xFFFFFFU);
          ASSERT_EQ(rgb.levels[3 * x + 1], in ? d.levels[x - d.span.column] >> 8 & 0xFF : 2U);
        }
      }
    }
  }
}

// Of every width, many spans in one call.
TEST_P(FrameStoreTest, ShowsWhatRegistersOfAnyWidthStepThrough) {
  for (const unsigned word : {12U, 18U, 31U, 32U, 33U, 40U, 64U})
    for (const unsigned depth_bits : {8U, 24U, 32U}) {
      FrameStore::Format format_of_it = format();
      format_of_it.pixels = {word, word - 10, depth_bits, std::min(8U, 32 - depth_bits)};
      format_of_it.farthest = depth_bits == 32 ? ~0U : (1U << depth_bits) - 1;
      FrameStoreParameters parameters;
      parameters.depth_test = false;
      FrameStore store(parameters, format_of_it, GetParam());
      store.clear();
      std::vector<std::uint32_t> levels(kColumns * kLines, 0x030201), depth(levels.size(), format_of_it.farthest);
      std::vector<span_unit::Span> list;
      for (const Drawn& d : spans(60, format_of_it.pixels)) {
        list.push_back(d.span);
        const std::size_t at = d.span.line * kColumns + d.span.column;
        std::copy(d.levels.begin(), d.levels.end(), levels.begin() + static_cast<std::ptrdiff_t>(at));
        std::copy(d.depths.begin(), d.depths.end(), depth.begin() + static_cast<std::ptrdiff_t>(at));
      }
      store.draw(list, 1, 0);
      store.swap();
      frame::Frame shown;
      store.observe(shown);
      ASSERT_EQ(shown.depth, depth);
      frame::RgbLine rgb;
      rgb.resize(kColumns);
      for (std::uint32_t line = 0; line < kLines; ++line) {
        store.scan_out(line, rgb);
        for (std::uint32_t x = 0; x < 3 * kColumns; ++x)
          ASSERT_EQ(rgb.levels[x], levels[line * kColumns + x / 3] >> (8 * (x % 3)) & 0xFF) << word << " bits";
      }
    }
}

// Levels that are given, of the pixels that the registers would have stepped through: the same planes, counts and bits.
TEST_P(FrameStoreTest, DrawsGivenLevelsAsItDoesThoseOfRegisters) {
  using Keep = FrameStore::Keep;
  for (const Keep keep : {Keep::nothing, Keep::numbers, Keep::everything})
    for (const bool test : {true, false})
      for (const bool ties : {true, false}) {
        if (ties && keep == Keep::nothing) continue;
        FrameStoreParameters parameters;
        parameters.depth_test = test;
        FrameStore::Format format_of_it = format();
        format_of_it.keep = keep;
        format_of_it.ties = ties;
        FrameStore by_registers(parameters, format_of_it, GetParam()), given(parameters, format_of_it, GetParam());
        by_registers.clear();
        given.clear();
        std::vector<Drawn> drawn = spans(240);
        std::shuffle(drawn.begin(), drawn.end(), random_);
        for (std::size_t i = 0; i < drawn.size(); i += 3) {  // three spans and one
          const std::size_t count = i % 2 == 0 ? 3 : 1;
          std::vector<span_unit::Span> list;
          std::vector<std::uint32_t> levels;
          const std::uint32_t first = std::min(drawn[i].span.line, kLines - 3);
          for (std::size_t k = i; k < i + count; ++k) {
            drawn[k].span.line = first + static_cast<std::uint32_t>(k - i);
            list.push_back(drawn[k].span);
            levels.insert(levels.end(), drawn[k].levels.begin(), drawn[k].levels.end());
            for (std::size_t c = 0; c < span_unit::kDepthSet; ++c) drawn[k].span.i[c] = random_();  // nobody looks
          }
          std::vector<std::uint64_t> won(kColumns / 64 + 1), won_of_given(won.size());
          std::uint64_t* const bits = count == 1 ? won.data() : nullptr;
          std::uint64_t* const bits_of_given = count == 1 ? won_of_given.data() : nullptr;
          const std::uint32_t kept = by_registers.draw(list, drawn[i].object, 3, bits);
          for (std::size_t k = 0; k < count; ++k) list[k] = drawn[i + k].span;
          ASSERT_EQ(given.draw_levels(list, levels, drawn[i].object, 3, bits_of_given), kept);
          ASSERT_EQ(won_of_given, won);
        }
        by_registers.swap();
        given.swap();
        frame::Frame a, b;
        by_registers.observe(a);
        given.observe(b);
        EXPECT_EQ(b.depth, a.depth);
        EXPECT_EQ(b.object, a.object);
        EXPECT_EQ(b.material, a.material);
        EXPECT_EQ(b.coverage, a.coverage);
        frame::RgbLine rgb_a, rgb_b;
        rgb_a.resize(kColumns);
        rgb_b.resize(kColumns);
        for (std::uint32_t line = 0; line < kLines; ++line) {
          by_registers.scan_out(line, rgb_a);
          given.scan_out(line, rgb_b);
          ASSERT_EQ(rgb_b.levels, rgb_a.levels);
        }
        EXPECT_EQ(given.counters().fragments_in, by_registers.counters().fragments_in);
        EXPECT_EQ(given.counters().fragments_kept, by_registers.counters().fragments_kept);
      }
}

INSTANTIATE_TEST_SUITE_P(Variants, FrameStoreTest, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::frame_store
