// Counted<T> computes as T and counts what it does: the modelled host runs the geometry code with it, so that the
// operations charged to a transputer are those of the code that computed the coefficients.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "src/base/fixed_point.h"

namespace rastertlm::geometry {

struct OperationCounts {
  std::uint64_t add = 0;  // additions and subtractions
  std::uint64_t multiply = 0;
  std::uint64_t divide = 0;
  std::uint64_t square_root = 0;
  std::uint64_t compare = 0;
  std::uint64_t convert = 0;  // between integer and floating point
  std::uint64_t integer = 0;  // integer additions, shifts, logic
  std::uint64_t integer_multiply = 0;

  // What a sustained rate in flops counts: every floating-point operation as one.
  std::uint64_t flops() const { return add + multiply + divide + square_root + compare + convert; }

  OperationCounts& operator+=(const OperationCounts& o);
  friend OperationCounts operator-(OperationCounts a, const OperationCounts& b);
  friend OperationCounts operator*(OperationCounts a, std::uint64_t times);
  friend bool operator==(const OperationCounts&, const OperationCounts&) = default;
};

inline OperationCounts& OperationCounts::operator+=(const OperationCounts& o) {
  add += o.add;
  multiply += o.multiply;
  divide += o.divide;
  square_root += o.square_root;
  compare += o.compare;
  convert += o.convert;
  integer += o.integer;
  integer_multiply += o.integer_multiply;
  return *this;
}

inline OperationCounts operator-(OperationCounts a, const OperationCounts& b) {
  a.add -= b.add;
  a.multiply -= b.multiply;
  a.divide -= b.divide;
  a.square_root -= b.square_root;
  a.compare -= b.compare;
  a.convert -= b.convert;
  a.integer -= b.integer;
  a.integer_multiply -= b.integer_multiply;
  return a;
}

inline OperationCounts operator*(OperationCounts a, std::uint64_t times) {
  a.add *= times;
  a.multiply *= times;
  a.divide *= times;
  a.square_root *= times;
  a.compare *= times;
  a.convert *= times;
  a.integer *= times;
  a.integer_multiply *= times;
  return a;
}

// Counts of this thread since it started; take differences.
inline constinit thread_local OperationCounts operation_counts;

template <class T>
class Counted {
 public:
  Counted() = default;
  constexpr Counted(T value)
      : value_(value) {}  // NOLINT(google-explicit-constructor): constants of the formulas cost nothing
  template <class U>
  requires(std::is_arithmetic_v<U> && !std::is_same_v<U, T>) constexpr Counted(U value)
      : value_(static_cast<T>(value)) {}  // NOLINT(google-explicit-constructor)
  constexpr T value() const { return value_; }

  Counted& operator+=(Counted o) { return *this = *this + o; }
  Counted& operator-=(Counted o) { return *this = *this - o; }
  Counted& operator*=(Counted o) { return *this = *this * o; }
  Counted& operator/=(Counted o) { return *this = *this / o; }

  friend Counted operator-(Counted a) { return Counted(-a.value_); }
  friend Counted operator+(Counted a, Counted b) {
    ++operation_counts.add;
    return Counted(a.value_ + b.value_);
  }
  friend Counted operator-(Counted a, Counted b) {
    ++operation_counts.add;
    return Counted(a.value_ - b.value_);
  }
  friend Counted operator*(Counted a, Counted b) {
    ++operation_counts.multiply;
    return Counted(a.value_ * b.value_);
  }
  friend Counted operator/(Counted a, Counted b) {
    ++operation_counts.divide;
    return Counted(a.value_ / b.value_);
  }
  friend bool operator<(Counted a, Counted b) { return compared(a.value_ < b.value_); }
  friend bool operator>(Counted a, Counted b) { return compared(a.value_ > b.value_); }
  friend bool operator<=(Counted a, Counted b) { return compared(a.value_ <= b.value_); }
  friend bool operator>=(Counted a, Counted b) { return compared(a.value_ >= b.value_); }
  friend bool operator==(Counted a, Counted b) { return compared(a.value_ == b.value_); }

 private:
  static bool compared(bool result) {
    ++operation_counts.compare;
    return result;
  }
  T value_;  // no initialiser: GLM keeps components in unions, which want trivial types
};

// The same calls for a plain and for a counted number.
inline double square_root(double x) { return std::sqrt(x); }
inline float square_root(float x) { return std::sqrt(x); }
template <class T>
Counted<T> square_root(Counted<T> x) {
  ++operation_counts.square_root;
  return Counted<T>(square_root(x.value()));
}

// Round half up to an integer; one conversion.
inline std::int64_t to_integer(double x) { return round_half_up(x); }
template <class T>
std::int64_t to_integer(Counted<T> x) {
  ++operation_counts.convert;
  return round_half_up(static_cast<double>(x.value()));
}

// An integer as a number; one conversion.
template <class T>
T from_integer(std::int64_t i) {
  if constexpr (!std::is_arithmetic_v<T>) ++operation_counts.convert;
  return T(static_cast<double>(i));
}

// Charges integer work of the code beside it to a counted host; costs nothing otherwise.
template <class T>
void charge_integer([[maybe_unused]] std::uint64_t simple, [[maybe_unused]] std::uint64_t multiplications) {
  if constexpr (!std::is_arithmetic_v<T>) {
    operation_counts.integer += simple;
    operation_counts.integer_multiply += multiplications;
  }
}

inline double plain(double x) { return x; }
template <class T>
double plain(Counted<T> x) {
  return static_cast<double>(x.value());
}

}  // namespace rastertlm::geometry
