// Quantities that must not be mixed: cycles of a clock, and the clock that they belong to.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace rastertlm {

// A number of cycles of a clock that is named beside it. Never negative.
class Cycles {
 public:
  constexpr Cycles() = default;
  explicit constexpr Cycles(std::uint64_t count) : count_(count) {}
  constexpr std::uint64_t count() const { return count_; }

  constexpr Cycles& operator+=(Cycles other) {
    count_ += other.count_;
    return *this;
  }
  friend constexpr Cycles operator+(Cycles a, Cycles b) { return Cycles(a.count_ + b.count_); }
  friend constexpr Cycles operator-(Cycles a, Cycles b) { return Cycles(a.count_ - b.count_); }  // a >= b
  friend constexpr Cycles operator*(Cycles a, std::uint64_t n) { return Cycles(a.count_ * n); }
  friend constexpr auto operator<=>(Cycles, Cycles) = default;

 private:
  std::uint64_t count_ = 0;
};

// A named clock with an exact rational period: numerator / denominator picoseconds.
class Clock {
 public:
  Clock() = default;
  static Clock from_frequency_hz(std::string name, std::uint64_t hz);
  // The period is taken to the nearest femtosecond.
  static Clock from_period_ns(std::string name, double ns);
  // One tick in `cycles` cycles of `clock`.
  static Clock slower(std::string name, const Clock& clock, std::uint64_t cycles);

  const std::string& name() const { return name_; }
  double frequency_hz() const;
  double period_ns() const;

  // Counted first, converted once: the end of cycle `n` in picoseconds, rounded to nearest (n * period < 2^63 ps).
  std::uint64_t picoseconds(Cycles n) const {
    // Most clocks have a whole number of picoseconds.
    return denominator_ == 1 ? n.count() * numerator_ps_ : rounded_picoseconds(n);
  }
  double seconds(Cycles n) const;
  // round(seconds / period).
  Cycles cycles_round(double seconds) const;
  // The first cycle that starts at or after `picoseconds`.
  Cycles cycles_at(std::uint64_t picoseconds) const;

 private:
  Clock(std::string name, std::uint64_t numerator_ps, std::uint64_t denominator);
  std::uint64_t rounded_picoseconds(Cycles n) const;
  std::string name_;
  std::uint64_t numerator_ps_ = 1;
  std::uint64_t denominator_ = 1;
};

}  // namespace rastertlm
