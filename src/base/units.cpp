#include "src/base/units.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace rastertlm {
namespace {
__extension__ using Wide = unsigned __int128;
constexpr std::uint64_t kPicosecondsPerSecond = 1'000'000'000'000;
constexpr std::uint64_t kFemtosecondsPerPicosecond = 1000;

// Most fit into a word, and divisions of words are much the faster.
std::uint64_t quotient(Wide dividend, std::uint64_t divisor) {
  const auto low = static_cast<std::uint64_t>(dividend);
  if (dividend == low) return divisor == 1 ? low : low / divisor;
  return static_cast<std::uint64_t>(dividend / divisor);
}
}  // namespace

Clock::Clock(std::string name, std::uint64_t numerator_ps, std::uint64_t denominator) : name_(std::move(name)) {
  const std::uint64_t divisor = std::gcd(numerator_ps, denominator);
  numerator_ps_ = numerator_ps / divisor;
  denominator_ = denominator / divisor;
}

Clock Clock::from_frequency_hz(std::string name, std::uint64_t hz) {
  return Clock(std::move(name), kPicosecondsPerSecond, hz);
}

Clock Clock::from_period_ns(std::string name, double ns) {
  const auto femtoseconds = static_cast<std::uint64_t>(std::llround(ns * 1e6));
  return Clock(std::move(name), femtoseconds, kFemtosecondsPerPicosecond);
}

Clock Clock::slower(std::string name, const Clock& clock, std::uint64_t cycles) {
  return Clock(std::move(name), clock.numerator_ps_ * cycles, clock.denominator_);
}

double Clock::period_ns() const {
  return static_cast<double>(numerator_ps_) / (1e3 * static_cast<double>(denominator_));
}

double Clock::frequency_hz() const {
  return 1e12 * static_cast<double>(denominator_) / static_cast<double>(numerator_ps_);
}

std::uint64_t Clock::rounded_picoseconds(Cycles n) const {
  return quotient(static_cast<Wide>(n.count()) * numerator_ps_ + denominator_ / 2, denominator_);
}

double Clock::seconds(Cycles n) const { return static_cast<double>(picoseconds(n)) * 1e-12; }

Cycles Clock::cycles_round(double seconds) const {
  return Cycles(static_cast<std::uint64_t>(std::floor(seconds * frequency_hz() + 0.5)));
}

Cycles Clock::cycles_at(std::uint64_t picoseconds) const {
  // The least n with picoseconds(n) >= the time: picoseconds() rounds to nearest.
  const Wide product = static_cast<Wide>(picoseconds) * denominator_;
  const Wide half = denominator_ / 2;
  return Cycles(product <= half ? 0 : quotient(product - half + numerator_ps_ - 1, numerator_ps_));
}

}  // namespace rastertlm
