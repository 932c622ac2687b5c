// A dot-product unit (004, section 5.3.4): three tables of partial products of magnitudes, signs by exclusive or, and
// the terminate adder. The tables are memory that a loader fills (table_bank.h); this is what the unit does with what
// it reads from them.
#pragma once

#include <array>
#include <cstdint>

#include "modules/shading/normaliser.h"
#include "modules/shading/parameters.h"
#include "modules/shading/table_bank.h"

namespace rastertlm::shading {

class DotProduct {
 public:
  explicit DotProduct(const ShadingParameters& parameters)
      : centred_(parameters.arithmetic == Arithmetic::centred),
        // In units of half an LSB the centred sum has one bit more.
        full_scale_((std::int32_t{1} << (parameters.dot_table_output_bits + (centred_ ? 1 : 0))) - 1),
        index_shift_(
            static_cast<unsigned>(parameters.dot_table_output_bits - parameters.index_bits + (centred_ ? 1 : 0))) {}

  // A partial product with its sign. -A is taken as ~A: the missing 1 is the adder's "error of three LSB in the worse
  // case".
  static std::int32_t signed_term(std::uint32_t entry, bool negative) {
    return static_cast<std::int32_t>(entry) ^ -static_cast<std::int32_t>(negative);
  }

  // The terminate adder: signed, dot_table_output_bits + 3 bits. Centred, each term stands for itself plus half an LSB,
  // whatever its sign, so the sum is three halves more, counted in halves.
  std::int32_t sum(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const std::int32_t terms = x + y + z;
    return centred_ ? 2 * terms + 3 : terms;
  }
  // Negative sums are 0. Above full scale the adder saturates (at the centre of a highlight sums reach 2051.5: a
  // wrapped index would be a black dot in it).
  bool saturates(std::int32_t sum) const { return sum > full_scale_; }
  std::uint32_t index(std::int32_t sum) const {
    const std::int32_t positive = sum < 0 ? 0 : sum;
    return static_cast<std::uint32_t>(positive > full_scale_ ? full_scale_ : positive) >> index_shift_;
  }

  // The address within a material of the diffuse or specular table.
  std::uint32_t evaluate(const DotTables& tables, const NormalisedNormal& normal) const {
    std::array<std::int32_t, 3> term{};
    for (std::size_t i = 0; i < 3; ++i)
      term[i] = signed_term(tables.products[i][normal.magnitude[i]], normal.negative[i] != tables.negative[i]);
    return index(sum(term[0], term[1], term[2]));
  }

 private:
  bool centred_;
  std::int32_t full_scale_;
  unsigned index_shift_;
};

}  // namespace rastertlm::shading
