// How a long run's inputs are shared among cases.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "src/analysis/stability.h"

namespace rastertlm::analysis {
namespace {

double total(const std::vector<CaseCost>& cases, const std::vector<std::int64_t>& tries) {
  double sum = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) sum += cases[i].random_inputs * static_cast<double>(tries[i]);
  return sum;
}

TEST(SpreadInputs, GoWhereTheyAreCheapAndTakeAsLongForEach) {
  const std::vector<CaseCost> cases{{1.0, 1.0}, {18.0, 20.0}, {1.0, 1000.0}, {0.0, 0.0}};
  const auto tries = spread_inputs(cases, 1'901'000);  // and a fiftieth more
  EXPECT_NEAR(static_cast<double>(tries[0]), 1.02e6, 10);
  EXPECT_NEAR(static_cast<double>(tries[1]), 5.1e4, 1);
  EXPECT_NEAR(static_cast<double>(tries[2]), 1020, 1);
  EXPECT_EQ(tries[3], 0);
}

RC_GTEST_PROP(SpreadInputs, AreEnoughAndNoneIsLeftOut, ()) {
  const auto costs = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, 30), rc::gen::inRange(1, 100'000)));
  const std::int64_t wanted = *rc::gen::inRange<std::int64_t>(1, 10'000'000);
  std::vector<CaseCost> cases;
  cases.reserve(costs.size());
  for (const auto& [inputs, cost] : costs) cases.push_back({0.5 * inputs, 0.1 * cost});
  const auto tries = spread_inputs(cases, wanted);
  RC_ASSERT(tries.size() == cases.size());
  bool any = false;
  double longest = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    RC_ASSERT((cases[i].random_inputs > 0 ? tries[i] >= kFewestTries : tries[i] == 0));
    any = any || cases[i].random_inputs > 0;
    if (tries[i] > kFewestTries) longest = std::max(longest, static_cast<double>(tries[i]) * cases[i].try_us);
  }
  RC_ASSERT((!any || total(cases, tries) >= static_cast<double>(wanted)));
  // What is tried more often than it must be takes as long as any other, to a try.
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (tries[i] > kFewestTries) RC_ASSERT(static_cast<double>(tries[i] + 1) * cases[i].try_us >= longest * (1 - 1e-9));
}

}  // namespace
}  // namespace rastertlm::analysis
