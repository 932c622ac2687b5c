// Is a split the mean over all orders?
#include "src/analysis/blame_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace rastertlm::analysis {
namespace {

const std::vector<Step> kSteps5{Step::coefficients, Step::normaliser, Step::dot_product, Step::specular_table,
                                Step::output_rounding};

// Any number for any subset, the same for the same.
class RandomError {
 public:
  explicit RandomError(std::uint64_t seed) : random_(seed) {}
  double operator()(StepSet set) {
    unsigned key = 0;
    for (const Step step : kSteps5) key = 2 * key + (set.has(step) ? 1U : 0U);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_[key] = static_cast<double>(random_() % 1000) - 500.0;
  }

 private:
  std::mt19937_64 random_;
  std::map<unsigned, double> known_;
};

TEST(BlameSplit, IsTheMeanOverAllOrders) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomError error(seed);
    std::map<Step, double> sums;
    std::vector<Step> order = kSteps5;
    int orders = 0;
    do {
      StepSet exact;
      for (const Step step : order) {
        sums[step] += error(exact) - error(exact.with(step));
        exact = exact.with(step);
      }
      ++orders;
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(orders, 120);
    const std::vector<double> shares = split(kSteps5, [&](StepSet set) { return error(set); });
    double total = 0.0;
    for (std::size_t i = 0; i < kSteps5.size(); ++i) {
      EXPECT_NEAR(shares[i], sums[kSteps5[i]] / orders, 1e-9);
      total += shares[i];
    }
    StepSet all;
    for (const Step step : kSteps5) all = all.with(step);
    EXPECT_NEAR(total, error(StepSet()) - error(all), 1e-9);
  }
}

TEST(BlameSplit, GivesEachItsOwnWhereErrorsAdd) {
  const std::vector<double> own{3.0, -1.0, 0.0, 0.5, 7.0};
  const std::vector<double> shares = split(kSteps5, [&](StepSet exact) {
    double error = 0.0;
    for (std::size_t i = 0; i < kSteps5.size(); ++i) error += exact.has(kSteps5[i]) ? 0.0 : own[i];
    return error;
  });
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(shares[i], own[i], 1e-12);
  EXPECT_TRUE(split({}, [](StepSet) { return 1.0; }).empty());
}

}  // namespace
}  // namespace rastertlm::analysis
