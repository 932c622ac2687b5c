// Least squares with unknowns that the observations may not tell apart.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rastertlm::explore {

// One non-zero coefficient of an unknown.
struct Term {
  std::size_t unknown = 0;
  double coefficient = 0.0;
};

// Collects observations  sum of coefficient x unknown = figure,  solves them, and tells which sums of unknowns they
// determine. Memory grows with the square of the unknowns, solving with their cube.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns);
  void observe(std::span<const Term> terms, double figure);

  // Once, after all observations.
  void solve();
  // How many independent sums of unknowns the observations determine.
  std::size_t rank() const { return rank_; }
  // The value of a sum; none where the observations leave it open.
  std::optional<double> value(std::span<const Term> terms) const;
  // Of a sum that was observed: such are always determined.
  double fitted(std::span<const Term> terms) const;

 private:
  double& at(std::size_t row, std::size_t column) { return matrix_[row * (unknowns_ + 1) + column]; }
  double at(std::size_t row, std::size_t column) const { return matrix_[row * (unknowns_ + 1) + column]; }
  std::size_t unknowns_;
  std::size_t rank_ = 0;
  std::vector<double> matrix_;  // of the normal equations, the right side as last column; solved: reduced
  std::vector<bool> solved_;    // the unknown is expressed by those that are not
};

}  // namespace rastertlm::explore
