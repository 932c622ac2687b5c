// A number with a fixed binary point, for set-up processors without floating point: 64 bits, rounded to nearest,
// products and quotients through 128 bits. What overflows is no number any more, and stays so.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>

namespace rastertlm::set_up {

template <int kFractionBits>
class FixedNumber {
  __extension__ using Wide = __int128;

 public:
  FixedNumber() = default;
  FixedNumber(double value)  // NOLINT(google-explicit-constructor): as double, float and Counted
      : raw_(std::fabs(value) < kLargest ? static_cast<std::int64_t>(std::floor(std::ldexp(value, kFractionBits) + 0.5))
                                         : kNoNumber) {}

  bool is_number() const { return raw_ != kNoNumber; }
  double to_double() const {
    return is_number() ? std::ldexp(static_cast<double>(raw_), -kFractionBits)
                       : std::numeric_limits<double>::quiet_NaN();
  }

  friend FixedNumber operator-(FixedNumber a) { return a.is_number() ? of(-Wide{a.raw_}) : a; }
  friend FixedNumber operator+(FixedNumber a, FixedNumber b) { return both(a, b) ? of(Wide{a.raw_} + b.raw_) : none(); }
  friend FixedNumber operator-(FixedNumber a, FixedNumber b) { return both(a, b) ? of(Wide{a.raw_} - b.raw_) : none(); }
  friend FixedNumber operator*(FixedNumber a, FixedNumber b) {
    if (!both(a, b)) return none();
    return of((Wide{a.raw_} * b.raw_ + kHalf) >> kFractionBits);
  }
  friend FixedNumber operator/(FixedNumber a, FixedNumber b) {
    if (!both(a, b) || b.raw_ == 0) return none();
    const Wide numerator = Wide{a.raw_} * (Wide{1} << (kFractionBits + 1));
    Wide twice = numerator / b.raw_;
    if (numerator % b.raw_ != 0 && (numerator < 0) != (b.raw_ < 0)) --twice;  // downwards; rounded from its last bit
    return of((twice + 1) >> 1);
  }
  // Nothing is smaller or larger than what is no number.
  friend bool operator<(FixedNumber a, FixedNumber b) { return both(a, b) && a.raw_ < b.raw_; }
  friend bool operator>(FixedNumber a, FixedNumber b) { return b < a; }
  friend bool operator==(FixedNumber a, FixedNumber b) { return both(a, b) && a.raw_ == b.raw_; }

 private:
  static constexpr std::int64_t kNoNumber = std::numeric_limits<std::int64_t>::min();
  static constexpr double kLargest = static_cast<double>(std::int64_t{1} << (62 - kFractionBits));
  static constexpr std::int64_t kHalf = kFractionBits > 0 ? std::int64_t{1} << (kFractionBits - 1) : 0;

  static bool both(FixedNumber a, FixedNumber b) { return a.is_number() && b.is_number(); }
  static FixedNumber none() {
    FixedNumber result;
    result.raw_ = kNoNumber;
    return result;
  }
  static FixedNumber of(Wide raw) {
    constexpr Wide kMost = std::numeric_limits<std::int64_t>::max();
    FixedNumber result;
    result.raw_ = raw > kMost || raw < -kMost ? kNoNumber : static_cast<std::int64_t>(raw);
    return result;
  }

  std::int64_t raw_ = 0;
};

}  // namespace rastertlm::set_up
