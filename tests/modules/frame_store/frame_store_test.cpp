// Does the nearest stay, in any order and vector variant, and is nothing else touched?
#include "modules/frame_store/frame_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rastertlm::frame_store {
namespace {

constexpr std::uint32_t kColumns = 141;
constexpr std::uint32_t kLines = 7;

struct Drawn {
  std::uint32_t line, column, object;
  std::vector<std::uint32_t> levels, depths;
};

class FrameStoreTest : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{21};
  std::uint32_t number(std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution<std::uint32_t>(low, high)(random_);
  }
  std::vector<Drawn> spans(std::uint32_t count) {
    std::vector<Drawn> all;
    for (std::uint32_t i = 0; i < count; ++i) {
      Drawn d;
      d.line = number(0, kLines - 1);
      d.column = number(0, kColumns - 1);
      d.object = i + 1;
      const std::uint32_t length = number(1, kColumns - d.column);
      d.levels.resize(length + kSparePixels, 0xDEAD);
      d.depths.resize(length + kSparePixels, 0);  // nearer than all, and not to be looked at
      for (std::uint32_t x = 0; x < length; ++x) {
        d.levels[x] = number(0, 0xFFFFFF);
        d.depths[x] = number(0, 30);
      }
      all.push_back(std::move(d));
    }
    return all;
  }
  static span_unit::Span of(const Drawn& d) {
    span_unit::Span span;
    span.line = d.line;
    span.column = d.column;
    span.count = static_cast<std::uint32_t>(d.levels.size() - kSparePixels);
    span.levels = d.levels.data();
    span.depths = d.depths.data();
    return span;
  }
};

FrameStore::Format format() {
  FrameStore::Format format;
  format.columns = kColumns;
  format.lines = kLines;
  format.farthest = 0xFFFFFF;
  format.background = {1, 2, 3};
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
      for (std::uint32_t x = 0; x < of(d).count; ++x) {
        const std::size_t at = d.line * kColumns + d.column + x;
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
      kept += store.draw(of(d), d.object, d.object % 5);
      in += of(d).count;
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
      store.draw(of(d), d.object, 0, won.data());
      for (std::uint32_t x = 0; x < of(d).count; ++x) {
        const std::size_t at = d.line * kColumns + d.column + x;
        const bool wins = !test || d.depths[x] < depth[at] || (d.depths[x] == depth[at] && d.object < object[at]);
        ASSERT_EQ((won[x / 64] >> x % 64 & 1) != 0, wins) << x;
        if (wins) depth[at] = d.depths[x];
        if (wins) object[at] = d.object;
      }
    }
  }
}

TEST_P(FrameStoreTest, ShowsOneBufferWhileTheOtherIsDrawn) {
  const std::vector<Drawn> drawn = spans(2);
  FrameStore store({}, format(), GetParam());
  store.clear();
  store.draw(of(drawn[0]), 1, 0);
  store.swap();
  store.clear();
  store.draw(of(drawn[1]), 2, 0);
  frame::Frame shown;
  store.observe(shown);
  EXPECT_EQ(shown.object[drawn[0].line * kColumns + drawn[0].column], 1U);
  store.swap();
  store.observe(shown);
  EXPECT_EQ(shown.object[drawn[1].line * kColumns + drawn[1].column], 2U);
}

INSTANTIATE_TEST_SUITE_P(Variants, FrameStoreTest, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::frame_store
