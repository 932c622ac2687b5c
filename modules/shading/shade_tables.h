// The tables of a bank as the shading kernel reads them: levels of all channels side by side, dot-product tables as the
// light words that filled them. Only what a loader has finished can be read so; while a table holds anything else, pixels
// are shaded from the bank itself.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/shading/normaliser.h"
#include "modules/shading/parameters.h"
#include "modules/shading/shade_kernels.h"
#include "modules/shading/table_bank.h"

namespace rastertlm::shading {

class ShadeTables {
 public:
  // Nothing where the kernel cannot be used: literal arithmetic, wide words, levels of fewer than 8 bits, no light, or a
  // dot-product table that is not a ramp. `lights`: those that are lit.
  static std::optional<ShadeTables> of(const TableBank& bank, const Normaliser& normaliser,
                                       const ShadingParameters& parameters, unsigned magnitude_bits,
                                       const std::vector<std::size_t>& lights);

  // Everything but the pixels; valid while this lives.
  ShadeRequest request() const;

 private:
  bool read_light(const TableBank& bank, std::size_t light, const ShadingParameters& parameters);
  void add_ambient(const TableBank& bank, unsigned index_bits);

  ShadeRequest constants_;
  std::vector<std::uint16_t> root_;
  std::vector<ShadeLight> lights_;
  std::vector<std::vector<std::uint32_t>> diffuse_;
  std::vector<std::vector<std::uint32_t>> specular_;
  std::vector<std::uint32_t> ambient_;
};

// The light word whose ramp (table_filler.h, centred) the table is; nothing where it is none.
std::optional<std::uint16_t> ramp_word(const std::vector<std::uint16_t>& table, unsigned address_bits);

}  // namespace rastertlm::shading
