// How many accesses does a span take, where words hold several pixels and banks work side by side?
#include "modules/frame_store/memory_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <random>
#include <vector>

namespace rastertlm::frame_store {
namespace {

using Won = std::vector<bool>;

std::vector<std::uint64_t> bits_of(const Won& won) {
  std::vector<std::uint64_t> bits(won.size() / 64 + 1, 0);
  for (std::size_t x = 0; x < won.size(); ++x)
    if (won[x]) bits[x / 64] |= std::uint64_t{1} << x % 64;
  return bits;
}

std::uint64_t span_accesses(const MemoryLayout& layout, std::uint64_t column, const Won& won) {
  const auto kept = static_cast<std::uint64_t>(std::count(won.begin(), won.end(), true));
  return layout.span_accesses(column, won.size(), kept, bits_of(won).data());
}

// Every access waits in its bank's queue; in each access time every bank does one.
std::uint64_t by_queues(const MemoryLayout& layout, std::uint64_t column, const Won& won) {
  std::map<std::uint64_t, bool> groups;
  for (std::size_t x = 0; x < won.size(); ++x) {
    bool& written = groups[(column + x) / layout.pixels_a_word];
    written = written || won[x];
  }
  std::vector<std::deque<char>> queues(layout.banks);
  for (const auto& [group, written] : groups) {
    std::deque<char>& queue = queues[group % layout.banks];
    for (std::uint64_t i = 0; i < layout.depth_words; ++i) queue.push_back('r');
    for (std::uint64_t i = 0; written && i < layout.write_words; ++i) queue.push_back('w');
  }
  for (std::uint64_t time = 0;; ++time) {
    bool done = true;
    for (std::deque<char>& queue : queues) {
      if (queue.empty()) continue;
      queue.pop_front();
      done = false;
    }
    if (done) return time;
  }
}

TEST(MemoryLayout, TakesWhatTheQueuesOfItsBanksTake) {
  std::mt19937_64 random(5);
  std::map<std::uint64_t, int> by_pixels_a_word;
  for (int round = 0; round < 3000; ++round) {
    FrameStoreParameters parameters;
    parameters.width_bits = static_cast<std::int64_t>(std::array{8, 16, 32, 64, 96, 128, 200, 512}[random() % 8]);
    parameters.banks = static_cast<std::int64_t>(1 + random() % 5);
    parameters.depth_test = random() % 4 != 0;
    const MemoryLayout layout = MemoryLayout::of(parameters, 300, 10, 24, random() % 2 != 0);
    const std::uint64_t column = random() % 200;
    Won won(1 + random() % 100);
    const std::uint64_t often = random() % 4;  // of three: none, some, all
    for (std::size_t x = 0; x < won.size(); ++x) won[x] = random() % 3 < often;
    ASSERT_EQ(span_accesses(layout, column, won), by_queues(layout, column, won))
        << parameters.width_bits << " bits, " << parameters.banks << " banks, column " << column << ", " << won.size();
    ++by_pixels_a_word[layout.pixels_a_word];
  }
  EXPECT_GE(by_pixels_a_word.size(), 4U);
}

// By hand, from the widths.
TEST(MemoryLayout, PutsPixelsIntoWords) {
  FrameStoreParameters parameters;
  const auto layout = [&] { return MemoryLayout::of(parameters, 512, 512, 24, false); };
  EXPECT_EQ(layout().pixels_a_word, 1U);  // 48 bits of 64
  EXPECT_FALSE(layout().asks_which_won());
  EXPECT_EQ(layout().span_accesses(3, 10, 4, nullptr), 10U + 4);
  parameters.width_bits = 96;
  EXPECT_EQ(layout().pixels_a_word, 2U);
  EXPECT_EQ(span_accesses(layout(), 3, Won(10, false)), 6U);  // 3, 4-5 ... 12
  EXPECT_EQ(span_accesses(layout(), 4, Won(10, false)), 5U);
  EXPECT_EQ(span_accesses(layout(), 4, {true, true, false, false, false, true}), 3U + 2);
  EXPECT_EQ(span_accesses(layout(), 3, {true, true, false, false, false, true}), 4U + 3);
  parameters.banks = 4;
  EXPECT_EQ(span_accesses(layout(), 3, Won(10, true)), 2U + 2);
  parameters.width_bits = 16;
  parameters.banks = 1;
  EXPECT_EQ(layout().depth_words, 2U);
  EXPECT_EQ(layout().write_words, 3U);
  EXPECT_EQ(layout().line_accesses(), 512U * 2);
  EXPECT_EQ(layout().clear_accesses(), 512U * 512 * 3);
  EXPECT_EQ(layout().words_a_bank(), 512U * 512 * 3);
  parameters.depth_test = false;
  EXPECT_EQ(layout().depth_words, 0U);
  EXPECT_EQ(layout().write_words, 2U);
}

}  // namespace
}  // namespace rastertlm::frame_store
