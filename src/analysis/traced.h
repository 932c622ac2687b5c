// A number as a machine computes it in double, the same without rounding, and a bound of the difference that is carried
// along: the running error analysis of whatever formula is written with it.
#pragma once

#include <cmath>
#include <limits>

#include "src/analysis/exact_number.h"

namespace rastertlm::analysis {

class Traced {
 public:
  Traced() = default;
  constexpr Traced(double value) : value_(value), bound_(0.0), exact_(value) {}  // NOLINT(google-explicit-constructor)

  double value() const { return value_; }
  Quad exact() const { return exact_; }
  // |value - exact| is at most this; infinite where nothing is known.
  double bound() const { return bound_; }
  double error() const { return to_double(absolute(exact_ - value_)); }

  friend Traced operator-(const Traced& a) { return {-a.value_, a.bound_, -a.exact_}; }
  friend Traced operator+(const Traced& a, const Traced& b) {
    return rounded(a.value_ + b.value_, a.bound_ + b.bound_, a.exact_ + b.exact_);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    return rounded(a.value_ - b.value_, a.bound_ + b.bound_, a.exact_ - b.exact_);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    return rounded(a.value_ * b.value_,
                   std::fabs(a.value_) * b.bound_ + std::fabs(b.value_) * a.bound_ + a.bound_ * b.bound_,
                   a.exact_ * b.exact_);
  }
  // |a / b - a' / b'| <= (|da| + |a' / b'| |db|) / |b|, and |b| >= |b'| - |db|.
  friend Traced operator/(const Traced& a, const Traced& b) {
    const double quotient = a.value_ / b.value_;
    const double least = std::fabs(b.value_) - b.bound_;
    const double moved =
        least > 0.0 ? (a.bound_ + std::fabs(quotient) * b.bound_) / least : std::numeric_limits<double>::infinity();
    return rounded(quotient, moved, a.exact_ / b.exact_);
  }
  // As the machine sees them.
  friend bool operator<(const Traced& a, const Traced& b) { return a.value_ < b.value_; }
  friend bool operator>(const Traced& a, const Traced& b) { return a.value_ > b.value_; }
  friend bool operator<=(const Traced& a, const Traced& b) { return a.value_ <= b.value_; }
  friend bool operator>=(const Traced& a, const Traced& b) { return a.value_ >= b.value_; }
  friend bool operator==(const Traced& a, const Traced& b) { return a.value_ == b.value_; }

 private:
  Traced(double value, double bound, Quad exact) : value_(value), bound_(bound), exact_(exact) {}
  // The operation itself is off by half a last place; the bound, a sum of a few doubles, by much less than 1e-14 of it.
  static Traced rounded(double value, double moved, Quad exact) {
    constexpr double kHalfPlace = std::numeric_limits<double>::epsilon() / 2;
    return {value, (moved + std::fabs(value) * kHalfPlace) * (1 + 1e-14), exact};
  }

  double value_;  // no initialisers: GLM keeps components in unions, which want trivial types
  double bound_;
  Quad exact_;
};

inline double plain(const Traced& value) { return value.value(); }

}  // namespace rastertlm::analysis
