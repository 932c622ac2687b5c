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

  // A component's square, so that the sum of three has 2 w + 2 bits. Centred: the word stands for m + 1/2, and (2m+1)^2
  // / 4 floored is m (m+1). Literal: the squarer takes the word in two's complement, so that a negative one, ~m, gives
  // (m+1)^2; of the readings that the paper leaves open this is the one that reproduces the published end-to-end
  // figures of an independent program (end_to_end_test.cpp; with m^2 for both signs, means, percentiles and maxima fall
  // short).
  std::uint32_t square(std::uint32_t magnitude, std::uint32_t negative) const {
    const std::uint32_t word = magnitude + (centred_ ? 0 : negative);
    return word * (word + (centred_ ? 1 : 0));
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
  unsigned address_shift() const { return address_shift_; }  // squares to ROM address
  unsigned product_shift() const { return product_shift_; }
  double root_scale() const { return root_scale_; }             // an entry is round(scale / sqrt(squares)),
  std::uint32_t largest_root() const { return largest_root_; }  // but not more than this
  std::uint32_t short_limit() const { return short_limit_; }

 private:
  bool centred_;
  unsigned magnitude_bits_;
  std::uint32_t magnitude_mask_;
  unsigned address_shift_;
  unsigned product_shift_;
  std::uint32_t clamp_;
  std::uint32_t short_limit_;
  double root_scale_;
  std::uint32_t largest_root_;
  std::vector<std::uint16_t> rom_;  // words of normaliser_output_bits
};

}  // namespace rastertlm::shading
