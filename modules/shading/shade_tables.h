// The tables of a bank as the shading kernel reads them. The kernel computes what is a straight line instead of looking
// it up, so every entry of such a table is compared first: a table that holds anything else, because its loader has not
// finished or the arithmetic is another, is not read by the kernel, and pixels are shaded from the bank itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/shading/normaliser.h"
#include "modules/shading/parameters.h"
#include "modules/shading/shade_kernels.h"
#include "modules/shading/table_bank.h"

namespace rastertlm::shading {

class ShadeTables {
 public:
  // Nothing where the kernel cannot be used: literal arithmetic, words wider than the paper's, levels of fewer than 8
  // bits, more than 32 materials, no light, or a dot-product or diffuse table that is no ramp. `lights`: those that are
  // lit.
  static std::optional<ShadeTables> of(const TableBank& bank, const Normaliser& normaliser,
                                       const ShadingParameters& parameters, std::int64_t normal_bits,
                                       const std::vector<std::size_t>& lights, const ShadeKernels& kernels);

  // Everything but the pixels; valid while this lives.
  const ShadeRequest& request() const { return constants_; }

 private:
  bool read_light(const TableBank& bank, std::size_t light, const ShadingParameters& parameters);
  void read_roots(const Normaliser& normaliser, const ShadeKernels& kernels);

  ShadeRequest constants_;
  std::vector<std::uint16_t> root_;
  std::vector<ShadeLight> lights_;
  std::vector<std::array<std::vector<std::uint8_t>, 3>> specular_;  // a light
};

// The light word whose ramp (table_filler.h, centred) the table is; nothing where it is none.
std::optional<std::uint16_t> product_word(std::span<const std::uint16_t> table, unsigned address_bits);
// A constant whose ramp of levels (likewise) the table is; nothing where it is none.
std::optional<std::uint16_t> level_word(std::span<const std::uint8_t> table, unsigned index_bits,
                                        unsigned fraction_bits);

}  // namespace rastertlm::shading
