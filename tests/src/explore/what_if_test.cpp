#include "src/explore/what_if.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/src/explore/table_builder.h"

namespace rastertlm::explore {
namespace {

using Values = std::vector<std::size_t>;

// Rate, bits and error of a machine with 1, 2, 4, 8 units and words of 8, 12 or 16 bits, by hand.
SweepTable machine_table() {
  SweepTable table;
  table.axes = {axis_of("host.units", {"1", "2", "4", "8"}), axis_of("word_bits", {"16", "8", "12"}),
                axis_of("topology", {"\"tree\"", "\"pipeline\""})};
  table.objectives = {objective_of("rate_hz", Sense::maximise), objective_of("bits", Sense::minimise),
                      objective_of("error", Sense::minimise)};
  add_grid(table, [](const Values& v) {
    const double rate = std::min(50.0, 10.0 * std::pow(2.0, static_cast<double>(v[0])));
    const double bits = 100.0 * std::pow(2.0, static_cast<double>(v[0])) + std::vector<double>{16.0, 8.0, 12.0}[v[1]];
    const double error = std::vector<double>{0.5, 4.0, 1.0}[v[1]];
    return Figures{rate - (v[2] == 1 ? 1.0 : 0.0), bits - (v[2] == 1 ? 3.0 : 0.0), error};
  });
  return table;
}

std::size_t row_of(const SweepTable& table, const Values& values) {
  const auto found = std::ranges::find_if(table.rows, [&](const Row& row) { return row.values == values; });
  return static_cast<std::size_t>(found - table.rows.begin());
}

TEST(WhatIf, AnswersForTheRateAndForTheBitsAtEqualError) {
  const SweepTable table = machine_table();
  // Two units, 12 bits, a tree.
  const WhatIf found = find_what_if(table, row_of(table, {1, 2, 0}));
  // One unit, four; 8 bits, 16; a pipeline.
  ASSERT_EQ(found.moves.size(), 5U);
  EXPECT_EQ(found.moves[0].value, 0U);
  EXPECT_EQ(found.moves[1].value, 2U);
  EXPECT_EQ(found.moves[2].value, 1U);
  EXPECT_EQ(found.moves[3].value, 0U);
  EXPECT_EQ(found.moves[4].value, 1U);
  EXPECT_EQ(found.moves[1].gains, (Figures{20.0, -200.0, 0.0}));
  EXPECT_EQ(found.moves[4].gains, (Figures{-1.0, 3.0, 0.0}));
  // The most rate costs bits, and no move gives any for nothing.
  EXPECT_EQ(found.best[0].whatever, 1U);
  EXPECT_FALSE(found.best[0].no_worse.has_value());
  EXPECT_EQ(found.best[0].while_no_worse, (std::vector<std::optional<std::size_t>>{1, {}, 1}));
  // The most bits are saved by one unit; at equal error too; at equal rate by shorter words.
  EXPECT_EQ(found.best[1].whatever, 0U);
  EXPECT_EQ(found.best[1].while_no_worse, (std::vector<std::optional<std::size_t>>{2, 0, 0}));
  EXPECT_FALSE(found.best[1].no_worse.has_value());
  EXPECT_EQ(found.best[2].whatever, 3U);
  // Four bits of 212 are 1.9 %, one of 20 Hz is 5 %.
  EXPECT_EQ(find_what_if(table, found.from, 0.02).best[2].no_worse, 3U);
  EXPECT_FALSE(find_what_if(table, found.from, 0.018).best[2].no_worse.has_value());
  EXPECT_EQ(find_what_if(table, found.from, 0.05).best[1].no_worse, 4U);
}

TEST(WhatIf, ListsMovesThatCannotBeTaken) {
  SweepTable table = machine_table();
  const std::size_t from = row_of(table, {2, 2, 0});
  table.rows[row_of(table, {3, 2, 0})].state = State::failed;
  table.rows[row_of(table, {1, 2, 0})].state = State::waiting;
  table.rows[row_of(table, {2, 1, 0})].allowed = false;
  table.rows.erase(table.rows.begin() + static_cast<std::ptrdiff_t>(row_of(table, {2, 2, 1})));
  const WhatIf found = find_what_if(table, from);
  ASSERT_EQ(found.moves.size(), 5U);
  EXPECT_EQ(found.moves[0].state, MoveState::waiting);
  EXPECT_EQ(found.moves[1].state, MoveState::failed);
  EXPECT_EQ(found.moves[2].state, MoveState::breaks);
  EXPECT_EQ(found.moves[2].gains[1], 4.0);
  EXPECT_EQ(found.moves[3].state, MoveState::known);
  EXPECT_EQ(found.moves[4].state, MoveState::not_there);
  EXPECT_FALSE(found.moves[4].row.has_value());
  EXPECT_FALSE(found.moves[0].gains[0].has_value());
  EXPECT_FALSE(found.best[1].whatever.has_value());  // what saves bits breaks a constraint
  EXPECT_EQ(found.best[2].whatever, 3U);
  EXPECT_THROW(find_what_if(table, row_of(table, {1, 2, 0})), std::invalid_argument);
  EXPECT_THROW(find_what_if(table, table.rows.size()), std::invalid_argument);
  EXPECT_THROW(find_what_if(table, from, -0.1), std::invalid_argument);
}

TEST(WhatIf, TakesALostFigureAsWorse) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  SweepTable table;
  table.axes = {numbered_axis("size", 3), axis_of("kind", {"a", "b"})};
  table.objectives = {objective_of("bits", Sense::minimise), objective_of("psnr", Sense::maximise)};
  add_row(table, {1, 0}, {100.0, kInfinite});
  add_row(table, {0, 0}, {50.0, {}});
  add_row(table, {2, 0}, {90.0, 40.0});
  add_row(table, {1, 1}, {95.0, kInfinite});
  const WhatIf found = find_what_if(table, 0, 0.5);
  EXPECT_EQ(found.best[0].whatever, 0U);
  EXPECT_EQ(found.best[0].no_worse, 2U);  // infinite as before; a finite one is infinitely worse
  EXPECT_FALSE(found.moves[0].gains[1].has_value());
  EXPECT_EQ(found.moves[1].gains[1], -kInfinite);
  EXPECT_EQ(found.moves[2].gains[1], 0.0);
}

// Against every point of the table by definition: the best is one step away, no worse elsewhere, and none is better.
RC_GTEST_PROP(WhatIf, FindsTheBestOfAllNeighbours, ()) {
  SweepTable table;
  table.axes = {numbered_axis("a", 4), numbered_axis("b", 3), axis_of("c", {"x", "y", "z"})};
  table.objectives = {objective_of("up", Sense::maximise), objective_of("down", Sense::minimise),
                      objective_of("low", Sense::minimise)};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::uniform_int_distribution<int> figure(0, 3);
  add_grid(table, [&](const Values&) {
    return Figures{static_cast<double>(figure(random)), static_cast<double>(figure(random)),
                   static_cast<double>(figure(random))};
  });
  std::ranges::shuffle(table.rows, random);
  const std::size_t from = std::uniform_int_distribution<std::size_t>(0, table.rows.size() - 1)(random);
  const WhatIf found = find_what_if(table, from);
  const auto better = [&](const Row& row, std::size_t o) {
    const double up = *row.figures[o] - *table.rows[from].figures[o];
    return table.objectives[o].sense == Sense::maximise ? up : -up;
  };
  for (std::size_t o = 0; o < 3; ++o) {
    double whatever = 0.0;
    double no_worse = 0.0;
    for (const Row& row : table.rows) {
      const Values& base = table.rows[from].values;
      const auto step = [&](std::size_t a) {
        return row.values[a] > base[a] ? row.values[a] - base[a] : base[a] - row.values[a];
      };
      const std::size_t steps = step(0) + step(1) + (step(2) > 0 ? 1 : 0);
      if (steps != 1) continue;
      whatever = std::max(whatever, better(row, o));
      if (better(row, (o + 1) % 3) >= 0.0 && better(row, (o + 2) % 3) >= 0.0)
        no_worse = std::max(no_worse, better(row, o));
    }
    const auto gain = [&](const std::optional<std::size_t>& move) {
      return move ? better(table.rows[*found.moves[*move].row], o) : 0.0;
    };
    RC_ASSERT(gain(found.best[o].whatever) == whatever);
    RC_ASSERT(gain(found.best[o].no_worse) == no_worse);
  }
}

// What is given is not ours to change.
TEST(WhatIf, MovesNothingThatIsGiven) {
  SweepTable table;
  table.axes = {numbered_axis("size", 3), axis_of("kind", {"a", "b"})};
  table.objectives = {objective_of("bits", Sense::minimise)};
  add_grid(table, [](const std::vector<std::size_t>& v) { return Figures{static_cast<double>(10 * v[0] + v[1])}; });
  EXPECT_EQ(find_what_if(table, 3).moves.size(), 3U);
  table.axes[0].given = true;
  const WhatIf result = find_what_if(table, 3);
  ASSERT_EQ(result.moves.size(), 1U);
  EXPECT_EQ(result.moves[0].axis, 1U);
}

}  // namespace
}  // namespace rastertlm::explore
