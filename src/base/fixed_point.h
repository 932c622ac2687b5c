// Words of hardware: two's complement integers of a given width that wrap.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace rastertlm {

// The low `bits` bits set; bits in 0..64.
constexpr std::uint64_t low_mask(unsigned bits) {
  return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

// `value` modulo 2^bits, as an unsigned word of 1..64 bits.
constexpr std::uint64_t wrap_unsigned(std::int64_t value, unsigned bits) {
  return static_cast<std::uint64_t>(value) & low_mask(bits);
}

// The word's value as two's complement of 1..64 bits.
constexpr std::int64_t sign_extend(std::uint64_t word, unsigned bits) {
  const unsigned shift = 64 - bits;
  return static_cast<std::int64_t>(word << shift) >> shift;
}

// `value` modulo 2^bits, in [-2^(bits-1), 2^(bits-1)).
constexpr std::int64_t wrap_signed(std::int64_t value, unsigned bits) {
  return sign_extend(static_cast<std::uint64_t>(value), bits);
}

// The number of bits that a non-negative value needs; 0 for 0.
constexpr unsigned bit_length(std::uint64_t value) { return static_cast<unsigned>(std::bit_width(value)); }

// Rounding to nearest, half upwards: the only rounding of the model. |value| < 2^62.
// By truncation: a processor of 2003 has no instruction for floor, and a call costs more than all else here.
inline std::int64_t round_half_up(double value) {
  const double sum = value + 0.5;
  const auto towards_zero = static_cast<std::int64_t>(sum);
  return towards_zero - (static_cast<double>(towards_zero) > sum ? 1 : 0);
}

// Division of integers that rounds towards minus or plus infinity; divisor > 0.
constexpr std::int64_t floor_div(std::int64_t value, std::int64_t divisor) {
  const std::int64_t quotient = value / divisor;
  return quotient - ((value % divisor < 0) ? 1 : 0);
}
constexpr std::int64_t ceil_div(std::int64_t value, std::int64_t divisor) { return -floor_div(-value, divisor); }

}  // namespace rastertlm
