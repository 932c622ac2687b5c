#include "src/analysis/stability.h"

#include <algorithm>
#include <utility>

namespace rastertlm::analysis {
namespace {

std::int64_t count_inputs(Measured& found, std::int64_t tried) {
  std::int64_t most = 0, sum = 0;
  for (Measurement& m : found.measurements) {
    if (m.inputs == 0) m.inputs = std::max<std::int64_t>(tried, 1);
    most = std::max(most, m.inputs);
    sum += m.inputs;
  }
  return found.inputs_apart ? sum : most;
}

}  // namespace

std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries, const Tampering& tampering) {
  Trial trial{machine, Numbers(seed), tries, tampering};
  Measured found = hard_case.core->measure(trial);
  if (found.empty()) return std::nullopt;
  const std::int64_t inputs = count_inputs(found, trial.tried);
  return Finding{hard_case.name,
                 hard_case.kind,
                 hard_case.stresses,
                 hard_case.core->step(machine),
                 std::move(found.measurements),
                 std::move(found.notes),
                 inputs,
                 trial.tried > 0};
}

CaseCost cost_of(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed) {
  constexpr double kUs = 5000.0;
  const double try_us = hard_case.core->try_us(machine);
  const auto tries = std::max<std::int64_t>(1, static_cast<std::int64_t>(kUs / try_us));
  const std::optional<Finding> some = examine(hard_case, machine, seed, tries);
  if (!some || !some->random) return {};
  const std::optional<Finding> twice = examine(hard_case, machine, seed, 2 * tries);
  const std::int64_t more = (twice ? twice->inputs : 0) - some->inputs;
  return {static_cast<double>(more) / static_cast<double>(tries), try_us};
}

std::vector<std::int64_t> spread_inputs(const std::vector<CaseCost>& cases, std::int64_t inputs) {
  const auto tries_in = [](const CaseCost& one, double us) {
    return std::max(kFewestTries, static_cast<std::int64_t>(us / one.try_us));
  };
  const auto inputs_in = [&](double us) {
    double sum = 0.0;
    for (const CaseCost& one : cases)
      if (one.random_inputs > 0.0) sum += one.random_inputs * static_cast<double>(tries_in(one, us));
    return sum;
  };
  const double wanted = 1.02 * static_cast<double>(inputs);  // the average of some tries is not exact
  const bool none = inputs_in(0.0) == 0.0;
  double least = 0.0, enough = 1.0;  // microseconds for each case
  while (!none && inputs_in(enough) < wanted) enough *= 2;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = (least + enough) / 2;
    (inputs_in(middle) < wanted ? least : enough) = middle;
  }
  std::vector<std::int64_t> tries;
  tries.reserve(cases.size());
  for (const CaseCost& one : cases) tries.push_back(one.random_inputs > 0.0 ? tries_in(one, enough) : 0);
  return tries;
}

}  // namespace rastertlm::analysis
