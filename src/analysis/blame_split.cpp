#include "src/analysis/blame_split.h"

#include <bit>

namespace rastertlm::analysis {

std::vector<double> split(std::span<const Step> steps, const std::function<double(StepSet)>& error) {
  const std::size_t subsets = std::size_t{1} << steps.size();
  std::vector<double> errors(subsets);
  for (std::size_t subset = 0; subset < subsets; ++subset) {
    StepSet exact;
    for (std::size_t i = 0; i < steps.size(); ++i)
      if ((subset >> i & 1U) != 0) exact = exact.with(steps[i]);
    errors[subset] = error(exact);
  }
  // Of all orders, the share in which just those of a subset of s come before: s! (n - 1 - s)! / n!.
  const std::size_t n = steps.size();
  std::vector<double> weights(n, 1.0 / static_cast<double>(n == 0 ? 1 : n));
  for (std::size_t s = 1; s < n; ++s) weights[s] = weights[s - 1] * static_cast<double>(s) / static_cast<double>(n - s);
  std::vector<double> shares(n, 0.0);
  for (std::size_t subset = 0; subset < subsets; ++subset)
    for (std::size_t i = 0; i < n; ++i) {
      if ((subset >> i & 1U) != 0) continue;
      const auto before = static_cast<std::size_t>(std::popcount(subset));
      shares[i] += weights[before] * (errors[subset] - errors[subset | std::size_t{1} << i]);
    }
  return shares;
}

}  // namespace rastertlm::analysis
