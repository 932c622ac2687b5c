#include "src/explore/normal_equations.h"

#include <algorithm>
#include <cmath>

namespace rastertlm::explore {
namespace {

// Of an unknown's own weight: less is what rounding leaves of nothing.
constexpr double kNothing = 1e-9;

}  // namespace

NormalEquations::NormalEquations(std::size_t unknowns)
    : unknowns_(unknowns), matrix_(unknowns * (unknowns + 1), 0.0), solved_(unknowns, false) {}

void NormalEquations::observe(std::span<const Term> terms, double figure) {
  for (const Term& row : terms) {
    for (const Term& column : terms) at(row.unknown, column.unknown) += row.coefficient * column.coefficient;
    at(row.unknown, unknowns_) += row.coefficient * figure;
  }
}

void NormalEquations::solve() {
  std::vector<double> weight(unknowns_);
  for (std::size_t i = 0; i < unknowns_; ++i) weight[i] = at(i, i);
  for (rank_ = 0; rank_ < unknowns_; ++rank_) {
    // The unknown that is most its own: the matrix is symmetric and has no negative eigenvalue, so a pivot on the
    // diagonal is always there while there is a determined sum left.
    std::size_t pivot = unknowns_;
    double most = kNothing;
    for (std::size_t i = 0; i < unknowns_; ++i) {
      if (solved_[i] || weight[i] == 0.0) continue;
      const double left = at(i, i) / weight[i];
      if (left > most) {
        most = left;
        pivot = i;
      }
    }
    if (pivot == unknowns_) return;
    solved_[pivot] = true;
    const double scale = 1.0 / at(pivot, pivot);
    for (std::size_t column = 0; column <= unknowns_; ++column) at(pivot, column) *= scale;
    for (std::size_t row = 0; row < unknowns_; ++row) {
      const double factor = at(row, pivot);
      if (row == pivot || factor == 0.0) continue;
      for (std::size_t column = 0; column <= unknowns_; ++column) at(row, column) -= factor * at(pivot, column);
      at(row, pivot) = 0.0;
    }
  }
}

std::optional<double> NormalEquations::value(std::span<const Term> terms) const {
  std::vector<double> open(unknowns_, 0.0);
  double largest = 0.0;
  for (const Term& term : terms) {
    largest = std::max(largest, std::abs(term.coefficient));
    if (!solved_[term.unknown]) {
      open[term.unknown] += term.coefficient;
      continue;
    }
    for (std::size_t column = 0; column < unknowns_; ++column)
      if (!solved_[column]) open[column] -= term.coefficient * at(term.unknown, column);
  }
  for (const double left : open)
    if (std::abs(left) > 1e-6 * largest) return {};
  return fitted(terms);
}

double NormalEquations::fitted(std::span<const Term> terms) const {
  double sum = 0.0;
  for (const Term& term : terms)
    if (solved_[term.unknown]) sum += term.coefficient * at(term.unknown, unknowns_);
  return sum;
}

}  // namespace rastertlm::explore
