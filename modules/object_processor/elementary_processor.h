// The first order elementary processor, EP1 (004, figure 5.2), register by register: what every closed form of this
// unit must equal.
//
//   loading RAM -> backup RAM -> output latch -> adder slices -> slice registers -> synchronisation registers -> output
//
// During the pixel cycle of column x on line y (both from 0) the output is A x + B (y + 1) + C modulo 2^word_bits: B is
// added before the first line is shown, so the host loads C' = C - B.
#pragma once

#include <array>
#include <cstdint>

#include "modules/object_processor/microprogram.h"
#include "modules/object_processor/parameters.h"
#include "modules/object_processor/sliced_accumulator.h"

namespace rastertlm::object_processor {

class ElementaryProcessor {
 public:
  // word_bits 8..32, slice_bits 1..word_bits. RAMs and registers start at zero.
  explicit ElementaryProcessor(const ObjectProcessorParameters& parameters);

  // A bus write: the low word_bits of `word`; address 0..2 holds A, B, C.
  void write_loading(unsigned address, std::uint32_t word) { loading_.at(address) = word & word_mask_; }
  std::uint32_t loading(unsigned address) const { return loading_.at(address); }
  std::uint32_t backup(unsigned address) const { return backup_.at(address); }

  // One cycle; what is clocked changes at its end.
  void step(const Microinstruction& instruction);
  void run(const Microprogram& program);

  // The highest slice's register above the synchronisation registers of the others: to be read before the cycle's step.
  std::uint32_t output() const { return static_cast<std::uint32_t>(sum_.deskewed()); }

 private:
  void access_ram(const Microinstruction& instruction);

  std::uint32_t word_mask_;
  bool from_loading_ = false;
  std::array<std::uint32_t, 3> loading_{};
  std::array<std::uint32_t, 3> backup_{};
  std::uint32_t ram_output_ = 0;
  SlicedAccumulator sum_;
};

}  // namespace rastertlm::object_processor
