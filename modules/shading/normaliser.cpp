#include "modules/shading/normaliser.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"

namespace rastertlm::shading {

Normaliser::Normaliser(const ShadingParameters& parameters, std::int64_t normal_bits)
    : centred_(parameters.arithmetic == Arithmetic::centred),
      magnitude_bits_(static_cast<unsigned>(normal_bits - 1)),
      magnitude_mask_(static_cast<std::uint32_t>(low_mask(magnitude_bits_))),
      address_shift_(static_cast<unsigned>(2 * normal_bits - parameters.normaliser_address_bits)),
      // r is 2^(o+w-1) / |m|, and the product has to be 2^dot_table_address_bits m / |m|.
      product_shift_(static_cast<unsigned>(parameters.normaliser_output_bits + normal_bits - 2 -
                                           parameters.dot_table_address_bits)),
      clamp_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.dot_table_address_bits)))),
      short_limit_(std::uint32_t{1} << (2 * magnitude_bits_ - 2)),
      root_scale_(
          std::ldexp(1.0, static_cast<int>(parameters.normaliser_output_bits) + static_cast<int>(magnitude_bits_) - 1)),
      largest_root_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.normaliser_output_bits)))),
      rom_(std::size_t{1} << parameters.normaliser_address_bits) {
  const auto largest = static_cast<double>(largest_root_);
  for (std::size_t address = 0; address < rom_.size(); ++address) {
    const double centre = (static_cast<double>(address) + 0.5) * std::ldexp(1.0, static_cast<int>(address_shift_));
    rom_[address] = static_cast<std::uint16_t>(std::min(largest, std::floor(root_scale_ / std::sqrt(centre) + 0.5)));
  }
}

NormalisedNormal Normaliser::normalise(std::uint32_t word_x, std::uint32_t word_y, std::uint32_t word_z) const {
  const std::array<SignMagnitude, 3> in{read(word_x), read(word_y), read(word_z)};
  std::uint32_t squares = 0;
  for (const SignMagnitude& component : in) squares += square(component.magnitude, component.negative ? 1 : 0);
  const std::uint32_t root = inverse_root(squares);
  NormalisedNormal out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.magnitude[i] = product(in[i].magnitude, root);
    out.negative[i] = in[i].negative;
  }
  out.is_zero = (in[0].magnitude | in[1].magnitude | in[2].magnitude) == 0;
  out.is_short = !out.is_zero && is_short(squares);
  return out;
}

}  // namespace rastertlm::shading
