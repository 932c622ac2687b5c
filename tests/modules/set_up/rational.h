// Exact fractions, for identities.
#pragma once

#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace rastertlm::set_up::test {

class Rational {
  __extension__ using Wide = __int128;

 public:
  Rational() = default;
  Rational(double whole) : n_(static_cast<std::int64_t>(whole)) {}  // NOLINT(google-explicit-constructor)
  static Rational of(std::int64_t n, std::int64_t d) { return Rational(Wide{n}, Wide{d}); }

  bool is_zero() const { return n_ == 0; }
  double value() const { return static_cast<double>(n_) / static_cast<double>(d_); }

  friend Rational operator-(const Rational& a) { return Rational(-a.n_, a.d_); }
  friend Rational operator+(const Rational& a, const Rational& b) {
    return Rational(times(a.n_, b.d_) + times(b.n_, a.d_), times(a.d_, b.d_));
  }
  friend Rational operator-(const Rational& a, const Rational& b) { return a + -b; }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return Rational(times(a.n_, b.n_), times(a.d_, b.d_));
  }
  friend Rational operator/(const Rational& a, const Rational& b) {
    if (b.n_ == 0) throw std::domain_error("division by zero");
    return Rational(times(a.n_, b.d_), times(a.d_, b.n_));
  }
  friend bool operator==(const Rational& a, const Rational& b) { return a.n_ == b.n_ && a.d_ == b.d_; }
  friend bool operator<(const Rational& a, const Rational& b) { return times(a.n_, b.d_) < times(b.n_, a.d_); }

 private:
  static Wide times(Wide a, Wide b) {
    Wide product = 0;
    if (__builtin_mul_overflow(a, b, &product)) throw std::overflow_error("a fraction of more than 127 bits");
    return product;
  }
  static Wide common(Wide a, Wide b) { return b == 0 ? a : common(b, a % b); }
  Rational(Wide n, Wide d) : n_(n), d_(d) {
    Wide divisor = common(n < 0 ? -n : n, d < 0 ? -d : d);
    if (divisor == 0) divisor = 1;
    if (d < 0) divisor = -divisor;
    n_ /= divisor;
    d_ /= divisor;
  }

  Wide n_ = 0;
  Wide d_ = 1;
};

}  // namespace rastertlm::set_up::test
