// The normalisation unit (004, section 5.3.7): three squares, two adders, one inverse square root ROM, three products.
//
// A normal arrives as three words of `normal_bits`: a sign bit above a magnitude m of w = normal_bits - 1 bits. The
// pre-normalisation unit has complemented the bits of negative components (one's complement: the sign bit says that m
// stands for ~m, no +1 is added) and has shifted all three so that the largest has its top bit set.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "modules/shading/parameters.h"

namespace rastertlm::shading {

// A component as a unit reads it.
struct SignMagnitude {
  std::uint32_t magnitude = 0;
  bool negative = false;
};

// What the normaliser hands to the dot-product units: components in units of 2^-dot_table_address_bits.
struct NormalisedNormal {
  std::array<std::uint32_t, 3> magnitude{};
  std::array<bool, 3> negative{};
  bool is_short = false;  // the ROM's entry is clamped: the pixel darkens
  bool is_zero = false;   // no direction at all: diffuse and specular are 0
};

class Normaliser {
 public:
  // `normal_bits` 4..16; the widths have passed ShadingParameters::check.
  Normaliser(const ShadingParameters& parameters, std::int64_t normal_bits);

  SignMagnitude read(std::uint32_t word) const {
    return {word & magnitude_mask_, ((word >> magnitude_bits_) & 1U) != 0};
  }

  // Sum of squares: 2 w + 2 bits. Centred: sum of (2m+1)^2 / 4, floored, which is the sum of m (m+1).
  std::uint32_t sum_of_squares(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const std::uint32_t half = centred_ ? 1 : 0;
    return x * (x + half) + y * (y + half) + z * (z + half);
  }
  std::uint32_t inverse_root(std::uint32_t squares) const { return rom_[squares >> address_shift_]; }
  // A component times the inverse root, floored and clamped to the dot table's last address.
  std::uint32_t product(std::uint32_t magnitude, std::uint32_t root) const {
    const std::uint32_t value =
        centred_ ? ((2 * magnitude + 1) * root) >> (product_shift_ + 1) : (magnitude * root) >> product_shift_;
    return value < clamp_ ? value : clamp_;
  }
  // Below it the inverse root does not fit its word: the largest component is below half of full scale.
  bool is_short(std::uint32_t squares) const { return squares < short_limit_; }

  NormalisedNormal normalise(std::uint32_t word_x, std::uint32_t word_y, std::uint32_t word_z) const;

  const std::vector<std::uint16_t>& rom() const { return rom_; }

 private:
  bool centred_;
  unsigned magnitude_bits_;
  std::uint32_t magnitude_mask_;
  unsigned address_shift_;
  unsigned product_shift_;
  std::uint32_t clamp_;
  std::uint32_t short_limit_;
  std::vector<std::uint16_t> rom_;  // words of normaliser_output_bits
};

}  // namespace rastertlm::shading
