// How far a solver's quadratic may be off, proved by a running error analysis, and how far it is.
#pragma once

#include <array>
#include <limits>

#include "modules/set_up/quadratic_solver.h"
#include "src/analysis/exact_number.h"

namespace rastertlm::analysis {

inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Levels = std::array<double, 6>;  // whole

template <class T>
set_up::SixColours<T> six(const Levels& levels) {
  const auto at = [&](std::size_t i) { return T(static_cast<T>(levels[i])); };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

// Barycentric: of corners 2 and 3.
struct Weights {
  double v, w;
};

// |form - the quadratic through the levels| at the point, the form's coefficients taken as they are. `at`: corners 2
// and 3 from corner 1.
double error_of(const set_up::QuadraticForm<double>& form, const set_up::Offsets<double>& at, const Levels& levels,
                const Weights& point);
// The same of a linear form, through levels 0 .. 2.
double linear_error_of(const set_up::QuadraticForm<double>& form, const set_up::Offsets<double>& at,
                       const Levels& levels, const Weights& point);

// Of the barycentric solver in floating point, `u` half of the last place of 1. Infinite where the determinant has no
// digit that is right: nothing is proved then.
double floating_bound(const set_up::Offsets<double>& at, const Levels& levels, const Weights& point, double u);
// The same of the linear solver.
double floating_linear_bound(const set_up::Offsets<double>& at, const Levels& levels, const Weights& point, double u);
// In fixed point of 64 bits, `fraction_bits` of them. Infinite where a number may leave the word.
double fixed_bound(const set_up::Offsets<double>& at, const Levels& levels, const Weights& point, int fraction_bits);

}  // namespace rastertlm::analysis
