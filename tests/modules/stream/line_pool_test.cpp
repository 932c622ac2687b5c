// Does a line belong to whoever holds its handle, and is it used again instead of allocated again?
#include "modules/stream/line_pool.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace rastertlm::stream {
namespace {

TEST(LinePool, UsesAReturnedLineAgainAndClearsIt) {
  LinePool pool(40);
  LinePool::Handle line = pool.acquire();
  const frame::FragmentLine* first = line.get();
  const std::uint32_t* words = line->depth.data();
  EXPECT_EQ(line->columns(), 40U);
  EXPECT_EQ(line->columns(), 40U);
  line->extend(3, 30, 0xFFFFFF);
  line.reset();
  for (int i = 0; i < 100; ++i) {
    line = nullptr;
    line = pool.acquire();
    ASSERT_EQ(line.get(), first);
    ASSERT_EQ(line->depth.data(), words);
    ASSERT_TRUE(line->empty());
    line->extend(0, 40, 0xFFFFFF);
  }
}

TEST(LinePool, LinesThatAreHeldAreDifferent) {
  LinePool pool(8);
  std::vector<LinePool::Handle> held;
  std::set<const frame::FragmentLine*> lines;
  for (int i = 0; i < 10; ++i) {
    held.push_back(pool.acquire());
    lines.insert(held.back().get());
  }
  EXPECT_EQ(lines.size(), 10U);
  held.erase(held.begin() + 4, held.begin() + 7);
  for (int i = 0; i < 3; ++i) {
    held.push_back(pool.acquire());
    EXPECT_TRUE(lines.contains(held.back().get()));  // one of the three that came back
  }
  EXPECT_FALSE(lines.contains(pool.acquire().get()));
}

// Handing a line on hands on the duty to return it, once.
TEST(LinePool, AHandedOnLineStaysWithItsNewHolder) {
  LinePool pool(8);
  LinePool::Handle board = pool.acquire();
  frame::FragmentLine* line = board.get();
  LinePool::Handle decision = std::move(board);
  EXPECT_EQ(board.get(), nullptr);
  board.reset();
  EXPECT_NE(pool.acquire().get(), line);
  decision.reset();
  EXPECT_EQ(pool.acquire().get(), line);
}

}  // namespace
}  // namespace rastertlm::stream
