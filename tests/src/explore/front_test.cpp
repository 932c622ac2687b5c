#include "src/explore/front.h"

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

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// What "beats" says, pair by pair: in no objective worse, in one better; what is missing is worse than what is not.
bool beats(const SweepTable& table, const Row& a, const Row& b) {
  bool better = false;
  for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
    if (table.axes[axis].given && a.values[axis] != b.values[axis]) return false;
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    const bool has_a = a.figures[o] && !std::isnan(*a.figures[o]);
    const bool has_b = b.figures[o] && !std::isnan(*b.figures[o]);
    if (!has_a && has_b) return false;
    if (has_a && !has_b) better = true;
    if (!has_a || !has_b) continue;
    const double x = table.objectives[o].sense == Sense::maximise ? -*a.figures[o] : *a.figures[o];
    const double y = table.objectives[o].sense == Sense::maximise ? -*b.figures[o] : *b.figures[o];
    if (x > y) return false;
    if (x < y) better = true;
  }
  return better;
}

bool takes_part(const Row& row) { return row.state == State::done && row.allowed; }

Front brute_force(const SweepTable& table) {
  const std::size_t n = table.rows.size();
  Front front;
  front.compared.resize(n);
  front.beaten_by.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    front.compared[i] = takes_part(table.rows[i]);
    const bool beaten = std::ranges::any_of(
        table.rows, [&](const Row& other) { return takes_part(other) && beats(table, other, table.rows[i]); });
    if (front.compared[i] && !beaten) front.rows.push_back(i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!front.compared[i]) continue;
    const auto by = std::ranges::find_if(
        front.rows, [&](std::size_t other) { return beats(table, table.rows[other], table.rows[i]); });
    if (by != front.rows.end()) front.beaten_by[i] = *by;
  }
  return front;
}

// Codes: below 0 a missing figure of some kind, 0 and 1 states that are not compared.
SweepTable coded_table(const std::vector<int>& codes, std::size_t objectives, int values) {
  SweepTable table;
  for (std::size_t o = 0; o < objectives; ++o)
    table.objectives.push_back(objective_of("figure", o % 2 == 0 ? Sense::minimise : Sense::maximise));
  for (std::size_t i = 0; i + objectives < codes.size(); i += objectives + 1) {
    Figures figures;
    for (std::size_t o = 0; o < objectives; ++o) {
      const int code = codes[i + o];
      if (code == -2) {
        figures.emplace_back(std::nan(""));
      } else if (code == -1) {
        figures.emplace_back();
      } else if (code == values) {
        figures.emplace_back(o % 3 == 0 ? kInfinite : -kInfinite);
      } else {
        figures.emplace_back(code == 0 && i % 2 == 0 ? -0.0 : 0.5 * code);
      }
    }
    const int kind = codes[i + objectives];
    const State state = kind == -2 ? State::failed : kind == -1 ? State::waiting : State::done;
    add_row(table, {}, std::move(figures), state, kind != 0);
  }
  return table;
}

void expect_brute_force(const SweepTable& table) {
  const Front expected = brute_force(table);
  const Front found = find_front(table);
  RC_ASSERT(found.rows == expected.rows);
  RC_ASSERT(found.compared == expected.compared);
  RC_ASSERT(found.beaten_by == expected.beaten_by);
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    RC_ASSERT(found.has(i) == (std::ranges::count(expected.rows, i) == 1));
}

RC_GTEST_PROP(Front, IsThatOfBruteForceOnSmallTables, ()) {
  const auto objectives = *rc::gen::inRange<std::size_t>(0, 6);
  const int values = *rc::gen::inRange(1, 8);
  const auto codes = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-2, values + 1));
  expect_brute_force(coded_table(codes, objectives, values));
}

// Large enough for the tree to have inner nodes, with many ties and without.
RC_GTEST_PROP(Front, IsThatOfBruteForceOnTablesOfHundreds, ()) {
  const auto objectives = *rc::gen::inRange<std::size_t>(1, 7);
  const int values = *rc::gen::element(3, 12, 1000);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::uniform_int_distribution<int> code(-2, values);
  std::vector<int> codes((objectives + 1) * 400);
  std::ranges::generate(codes, [&] { return code(random); });
  expect_brute_force(coded_table(codes, objectives, values));
}

// Two axes that are given and one that is not: only points that agree in both are compared.
RC_GTEST_PROP(Front, OfEachCaseIsThatOfBruteForce, ()) {
  const auto objectives = *rc::gen::inRange<std::size_t>(0, 4);
  const int values = *rc::gen::element(2, 12);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::uniform_int_distribution<int> code(-2, values);
  std::vector<int> codes((objectives + 1) * 200);
  std::ranges::generate(codes, [&] { return code(random); });
  SweepTable table = coded_table(codes, objectives, values);
  table.axes = {numbered_axis("size", 3), numbered_axis("method", 5), numbered_axis("scene", 2)};
  table.axes[0].given = table.axes[2].given = true;
  for (Row& row : table.rows) row.values = {random() % 3, random() % 5, random() % 2};
  expect_brute_force(table);
  for (Row& row : table.rows)
    RC_ASSERT(case_of(table, row) == (std::vector<std::size_t>{row.values[0], row.values[2]}));
}

// On the plane of a constant sum nothing beats anything; a copy that is worse by one in one objective is beaten, first
// by whatever is first of the plane and nowhere above it.
TEST(Front, KeepsAHundredThousandPointsThatNoneBeats) {
  constexpr int kPlane = 50'000;
  SweepTable table;
  for (int o = 0; o < 4; ++o) table.objectives.push_back(objective_of("figure", Sense::minimise));
  std::mt19937 random(5);
  std::uniform_int_distribution<int> level(0, 1'000'000);
  for (int i = 0; i < kPlane; ++i) {
    const double a = level(random);
    const double b = level(random);
    const double c = level(random);
    add_row(table, {}, {a, b, c, -a - b - c});
  }
  for (int i = 0; i < kPlane; ++i) {
    Figures worse = table.rows[static_cast<std::size_t>(i)].figures;
    worse[static_cast<std::size_t>(i % 4)] = *worse[static_cast<std::size_t>(i % 4)] + 1.0;
    add_row(table, {}, std::move(worse));
  }
  const Front front = find_front(table);
  ASSERT_EQ(front.rows.size(), std::size_t{kPlane});
  EXPECT_EQ(front.rows.back(), std::size_t{kPlane - 1});
  for (std::size_t i = kPlane; i < table.rows.size(); i += 97) {
    ASSERT_TRUE(front.beaten_by[i].has_value());
    EXPECT_LE(*front.beaten_by[i], i - kPlane);
    EXPECT_TRUE(beats(table, table.rows[*front.beaten_by[i]], table.rows[i]));
  }
}

TEST(Front, OfEqualPointsHasAllOrNone) {
  SweepTable table;
  table.objectives = {objective_of("bits", Sense::minimise), objective_of("rate", Sense::maximise)};
  add_row(table, {}, {8.0, 50.0});
  add_row(table, {}, {8.0, 50.0});
  add_row(table, {}, {9.0, 50.0});
  add_row(table, {}, {9.0, 50.0});
  add_row(table, {}, {4.0, {}});  // the least bits: on the front for what it has
  add_row(table, {}, {4.5, {}});  // beaten by it
  add_row(table, {}, {1.0, 99.0}, State::done, false);
  add_row(table, {}, {1.0, 99.0}, State::failed);
  const Front front = find_front(table);
  EXPECT_EQ(front.rows, (std::vector<std::size_t>{0, 1, 4}));
  EXPECT_EQ(front.beaten_by, (std::vector<std::optional<std::size_t>>{{}, {}, 0, 0, {}, 4, {}, {}}));
  EXPECT_FALSE(front.has(6));
  EXPECT_FALSE(front.has(7));
}

TEST(Front, RefusesRowsWithoutAFigureEach) {
  SweepTable table;
  table.objectives = {objective_of("bits", Sense::minimise)};
  add_row(table, {}, {});
  EXPECT_THROW(find_front(table), std::invalid_argument);
}

}  // namespace
}  // namespace rastertlm::explore
