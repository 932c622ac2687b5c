#include "src/explore/sensitivity.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "src/explore/axis_order.h"
#include "tests/src/explore/table_builder.h"

namespace rastertlm::explore {
namespace {

using Values = std::vector<std::size_t>;

// 1, 2, 3, ... of a parameter each.
SweepTable table_of(const std::vector<std::size_t>& sizes) {
  SweepTable table;
  for (std::size_t a = 0; a < sizes.size(); ++a)
    table.axes.push_back(numbered_axis("parameter_" + std::to_string(a), sizes[a]));
  table.objectives = {objective_of("figure", Sense::minimise)};
  return table;
}

double mean_where(const SweepTable& table, std::size_t axis, std::size_t value) {
  double sum = 0.0;
  double count = 0.0;
  for (const Row& row : table.rows) {
    if (row.values[axis] != value) continue;
    sum += *row.figures[0];
    count += 1.0;
  }
  return sum / count;
}

// In a grid an effect is a difference of means, whatever the figures, and shares and rest are all of the variance.
RC_GTEST_PROP(Sensitivity, OfAGridIsTheDifferenceOfMeans, ()) {
  SweepTable table = table_of(*rc::gen::element(Values{2, 2}, Values{3, 4, 2}, Values{5, 1, 3}, Values{7}));
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::uniform_real_distribution<double> figure(-1e3, 1e6);
  add_grid(table, [&](const Values&) { return Figures{figure(random)}; });
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  RC_ASSERT(found.design == DesignKind::grid);
  RC_ASSERT(found.points == table.rows.size());
  double explained = 0.0;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    const Sensitivity& axis = found.axes[a];
    if (table.axes[a].values.size() < 2) {
      RC_ASSERT(axis.effects == Effects::undetermined);
      RC_ASSERT(!axis.span);
      continue;
    }
    std::vector<double> means;
    for (std::size_t v = 0; v < table.axes[a].values.size(); ++v) means.push_back(mean_where(table, a, v));
    for (std::size_t v = 0; v < means.size(); ++v)
      RC_ASSERT(std::abs(axis.differences[v].value() - (means[v] - means[0])) < 1e-3);
    const auto [least, most] = std::ranges::minmax_element(means);
    RC_ASSERT(axis.least_at == static_cast<std::size_t>(least - means.begin()));
    RC_ASSERT(axis.most_at == static_cast<std::size_t>(most - means.begin()));
    RC_ASSERT(std::abs(axis.span.value() - (*most - *least)) < 1e-3);
    explained += axis.share.value();
  }
  if (table.axes.size() == 1) {
    RC_ASSERT(!found.unexplained);  // as many unknowns as points
    RC_ASSERT(std::abs(explained - 1.0) < 1e-9);
  } else {
    RC_ASSERT(std::abs(explained + found.unexplained.value() - 1.0) < 1e-9);
  }
}

TEST(Sensitivity, OfOneAtATimeIsTheDifferenceFromTheBaseline) {
  SweepTable table = table_of({3, 4});
  add_row(table, {1, 2}, {100.0});
  table.baseline = 0;
  add_row(table, {0, 2}, {70.0});
  add_row(table, {2, 2}, {130.5});
  add_row(table, {1, 0}, {99.0});
  add_row(table, {1, 1}, {std::nullopt}, State::failed);
  add_row(table, {1, 3}, {104.0}, State::done, false);  // breaks a constraint: its figure is no less true
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_EQ(found.design, DesignKind::one_at_a_time);
  EXPECT_EQ(found.points, 5U);
  EXPECT_FALSE(found.unexplained.has_value());
  const auto near = [](const std::optional<double>& a, double b) { return a && std::abs(*a - b) < 1e-9; };
  const Sensitivity& first = found.axes.at(0);
  EXPECT_EQ(first.reference, 1U);
  EXPECT_TRUE(near(first.differences[0], -30.0) && near(first.differences[1], 0.0) && near(first.differences[2], 30.5));
  EXPECT_TRUE(near(first.span, 60.5));
  EXPECT_EQ(first.least_at, 0U);
  EXPECT_EQ(first.most_at, 2U);
  const Sensitivity& second = found.axes.at(1);
  EXPECT_EQ(second.reference, 2U);
  EXPECT_TRUE(near(second.differences[0], -1.0) && near(second.differences[3], 4.0));
  EXPECT_FALSE(second.differences[1].has_value());
  EXPECT_TRUE(near(second.span, 5.0));
}

// An additive figure at random points is found again, to the last effect, although values are not equally often there.
RC_GTEST_PROP(Sensitivity, OfRandomPointsFindsAdditiveEffects, ()) {
  SweepTable table = table_of({4, 3, 5});
  table.axes[1].values = {"\"tree\"", "\"pipeline\"", "\"other\""};
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  std::uniform_real_distribution<double> size(-100.0, 100.0);
  std::vector<std::vector<double>> effect;
  for (const Axis& axis : table.axes) {
    effect.emplace_back(axis.values.size());
    std::ranges::generate(effect.back(), [&] { return size(random); });
  }
  for (int i = 0; i < 80; ++i) {
    Values values;
    double figure = 1000.0;
    for (std::size_t a = 0; a < table.axes.size(); ++a) {
      values.push_back(std::uniform_int_distribution<std::size_t>(0, effect[a].size() - 1)(random));
      figure += effect[a][values[a]];
    }
    add_row(table, values, {figure});
  }
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  RC_ASSERT(found.design == DesignKind::scattered);
  RC_ASSERT(found.unexplained.value() < 1e-9);
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    const Sensitivity& axis = found.axes[a];
    RC_ASSERT(axis.effects == Effects::by_value);
    for (std::size_t v = 0; v < effect[a].size(); ++v)
      if (axis.points[v] > 0)
        RC_ASSERT(std::abs(axis.differences[v].value() - (effect[a][v] - effect[a][axis.reference])) < 1e-6);
  }
}

// Every value once: each axis is a line. The slopes of a plane are found; a bend is what is not explained.
TEST(Sensitivity, OfALatinHypercubeIsALineAnAxis) {
  constexpr std::size_t kPoints = 40;
  SweepTable table = table_of({kPoints, kPoints, kPoints});
  std::mt19937 random(11);
  std::vector<Values> order(3, Values(kPoints));
  for (Values& values : order) {
    std::iota(values.begin(), values.end(), std::size_t{0});
    std::ranges::shuffle(values, random);
  }
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Values values{order[0][i], order[1][i], order[2][i]};
    add_row(table, values, {5.0 + 3.0 * static_cast<double>(values[0]) - 2.0 * static_cast<double>(values[1])});
  }
  ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_EQ(found.unknowns, 4U);
  EXPECT_LT(found.unexplained.value(), 1e-9);
  EXPECT_EQ(found.axes[0].effects, Effects::by_line);
  EXPECT_NEAR(found.axes[0].span.value(), 3.0 * (kPoints - 1), 1e-6);
  EXPECT_EQ(found.axes[0].most_at, kPoints - 1);
  EXPECT_NEAR(found.axes[1].span.value(), 2.0 * (kPoints - 1), 1e-6);
  EXPECT_EQ(found.axes[1].most_at, 0U);
  EXPECT_NEAR(found.axes[2].span.value(), 0.0, 1e-6);
  // In a Latin hypercube a parabola about the middle is seen by no line through balanced values, but for chance.
  for (Row& row : table.rows) row.figures[0] = std::pow(static_cast<double>(row.values[0]) - 19.5, 2);
  found = find_sensitivity(table).at(0);
  EXPECT_GT(found.unexplained.value(), 0.7);
}

TEST(Sensitivity, SaysNothingOfWhatChangedTogether) {
  SweepTable table = table_of({3, 3, 2});
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 2; ++j) add_row(table, {i, i, j}, {static_cast<double>(10 * i + j)});
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_EQ(found.axes[0].effects, Effects::undetermined);
  EXPECT_FALSE(found.axes[0].span.has_value());
  EXPECT_FALSE(found.axes[1].span.has_value());
  ASSERT_TRUE(found.axes[2].span.has_value());
  EXPECT_NEAR(*found.axes[2].span, 1.0, 1e-9);
}

TEST(Sensitivity, LeavesOutWhatIsMissingOrInfinite) {
  SweepTable table = table_of({4});
  add_row(table, {0}, {3.0});
  add_row(table, {1}, {std::numeric_limits<double>::infinity()});
  add_row(table, {2}, {std::nullopt});
  add_row(table, {3}, {8.0});
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_EQ(found.points, 2U);
  EXPECT_EQ(found.infinite, 1U);
  EXPECT_NEAR(found.axes[0].span.value(), 5.0, 1e-9);
  EXPECT_FALSE(found.axes[0].differences[1].has_value());
}

TEST(Sensitivity, OfAFigureThatDoesNotMoveIsNoneOfItsVariance) {
  SweepTable table = table_of({2, 3});
  add_grid(table, [](const Values&) { return Figures{0.1}; });
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_NEAR(found.axes[0].span.value(), 0.0, 1e-12);
  EXPECT_FALSE(found.axes[0].share.has_value());
  EXPECT_FALSE(found.unexplained.has_value());
}

TEST(Sensitivity, OfNothingIsNothing) {
  SweepTable table = table_of({2, 3});
  EXPECT_EQ(find_sensitivity(table).at(0).points, 0U);
  table.objectives.clear();
  EXPECT_TRUE(find_sensitivity(table).empty());
  add_row(table, {0, 3}, {});
  EXPECT_THROW(find_sensitivity(table), std::invalid_argument);
}

// A thousand values of two parameters: no matrix of that size is made.
TEST(Sensitivity, TakesAxesOfVeryManyValuesAsLines) {
  SweepTable table = table_of({1000, 1000});
  std::mt19937 random(4);
  std::uniform_int_distribution<std::size_t> value(0, 999);
  for (int i = 0; i < 20'000; ++i) {
    const Values values{value(random), value(random)};
    add_row(table, values, {static_cast<double>(values[0]) + 0.5 * static_cast<double>(values[1])});
  }
  const ObjectiveSensitivity found = find_sensitivity(table).at(0);
  EXPECT_EQ(found.unknowns, 3U);
  EXPECT_NEAR(found.axes[0].span.value(), 999.0, 1e-5);
  EXPECT_NEAR(found.axes[1].span.value(), 499.5, 1e-5);
}

TEST(AxisOrder, ReadsNumbersAsAMachineFileHasThem) {
  EXPECT_EQ(number_of("8"), 8.0);
  EXPECT_EQ(number_of("-1e3"), -1000.0);
  EXPECT_EQ(number_of("+60.5"), 60.5);
  EXPECT_EQ(number_of("1_024"), 1024.0);
  for (const char* text : {"", "tree", "\"8\"", "8 MHz", "true", "[1, 2]", "inf", "nan"})
    EXPECT_FALSE(number_of(text).has_value()) << text;
}

TEST(AxisOrder, StepsToNeighboursOfNumbersAndToAnyName) {
  const Axis numbers = axis_of("units", {"8", "2", "16", "4"});
  EXPECT_EQ(one_step_from(numbers, 0), (Values{3, 2}));
  EXPECT_EQ(one_step_from(numbers, 1), (Values{3}));
  EXPECT_EQ(one_step_from(numbers, 2), (Values{0}));
  const Axis names = axis_of("topology", {"\"tree\"", "\"pipeline\"", "\"bus\""});
  EXPECT_EQ(one_step_from(names, 1), (Values{0, 2}));
}

}  // namespace
}  // namespace rastertlm::explore
