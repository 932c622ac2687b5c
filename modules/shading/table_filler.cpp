#include "modules/shading/table_filler.h"

namespace rastertlm::shading {

Ramp product_ramp(std::uint32_t light_word, unsigned address_bits, Arithmetic arithmetic) {
  const std::uint32_t entries = std::uint32_t{1} << address_bits;
  if (arithmetic == Arithmetic::literal) return {light_word, 0, address_bits, entries};
  return {2 * std::uint64_t{light_word}, light_word, address_bits + 1, entries};
}

Ramp level_ramp(std::uint32_t constant, unsigned index_bits, unsigned fraction_bits, Arithmetic arithmetic) {
  const std::uint32_t entries = std::uint32_t{1} << index_bits;
  const unsigned error_bits = index_bits + fraction_bits;
  if (arithmetic == Arithmetic::literal) return {constant, 0, error_bits, entries};
  return {2 * std::uint64_t{constant}, constant + (std::uint64_t{1} << error_bits), error_bits + 1, entries};
}

PathScale path_scale(std::uint32_t ks, unsigned level_bits, Arithmetic arithmetic) {
  return {ks, arithmetic == Arithmetic::literal ? 0 : std::uint32_t{1} << (level_bits - 1), level_bits};
}

FillStep RampFiller::step() {
  const FillStep step{address_, static_cast<std::uint32_t>(word_ >> ramp_.error_bits), true};
  word_ += ramp_.increment;
  ++address_;
  return step;
}

FillStep PathFiller::step() {
  const FillStep step{address_, value_, moves_[position_] == Move::right};
  if (moves_[position_] == Move::right) {
    ++address_;
  } else {
    error_ += scale_.ks;
    const std::uint32_t overflow = error_ >> scale_.error_bits;
    value_ += overflow;
    error_ -= overflow << scale_.error_bits;
  }
  ++position_;
  return step;
}

Ramp slice(const Ramp& ramp, std::uint32_t first, std::uint32_t entries) {
  return {ramp.increment, ramp.preset + first * ramp.increment, ramp.error_bits, entries};
}

}  // namespace rastertlm::shading
