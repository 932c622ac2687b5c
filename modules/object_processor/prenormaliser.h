// The pre-normalisation unit (004, section 5.2.3): three words of a normal become three short words that share a shift.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "modules/object_processor/parameters.h"
#include "modules/object_processor/span_kernels.h"
#include "src/base/vector_variant.h"

namespace rastertlm::object_processor {

// What crosses the link: normal_bits each, the sign above the magnitude m. A word stands for the centre of its
// interval,
// +-(m + 1/2): with one's complement that holds for both signs.
using LinkNormal = std::array<std::uint16_t, 3>;

// m_i = |N_i| by one's complement (negative: ~N_i), K = max(0, bits of the largest m - (normal_bits - 1)), and m_i >>
// K.
class Prenormaliser {
 public:
  explicit Prenormaliser(const ObjectProcessorParameters& parameters, VectorVariant variant = vector_variant());

  // `normal`: words of word_bits, two's complement; bits above are ignored.
  LinkNormal operator()(const std::array<std::uint32_t, 3>& normal) const;
  unsigned shift_of(const std::array<std::uint32_t, 3>& normal) const;  // K

  // The same for `count` pixels; arrays do not overlap.
  void line(std::array<const std::uint32_t*, 3> normal, std::array<std::uint16_t*, 3> link, std::size_t count) const;

  unsigned largest_shift() const { return largest_shift_; }  // K is in 0..largest_shift: 12 for 24 and 12 bits
  unsigned shifters() const;                                 // fixed shifters of 1, 2, 4, ... a component: 4 for 12

 private:
  unsigned word_bits_;
  unsigned normal_bits_;
  unsigned largest_shift_;
  const SpanKernels* kernels_;
};

// For observers: a link word in half units of its last place, sign * (2 m + 1).
constexpr std::int32_t half_units(std::uint16_t link_word, unsigned normal_bits) {
  const auto magnitude = static_cast<std::int32_t>(link_word & ((1U << (normal_bits - 1)) - 1));
  const bool negative = (link_word >> (normal_bits - 1) & 1U) != 0;
  return negative ? -(2 * magnitude + 1) : 2 * magnitude + 1;
}

}  // namespace rastertlm::object_processor
