// A register and the adder before it, cut into slices that each lag the one below by a clock (004, figure 5.2): what
// the elementary processors add with.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/object_processor/parameters.h"

namespace rastertlm::object_processor {

class SlicedAccumulator {
 public:
  // word_bits 1..64, slice_bits 1..word_bits, at most 32 slices. Starts cleared.
  SlicedAccumulator(unsigned word_bits, unsigned slice_bits, CarryClock carry_clock);

  void clear();  // slice registers, carry flip-flops and synchronisation registers
  // One edge: slice i, where bit i of `clocks` is set, takes its sum with its bits of `addend` and the carry into it.
  void clock(std::uint64_t addend, std::uint32_t clocks);

  // What the slice registers hold, each its own step of the sum.
  std::uint64_t word() const;
  // The highest slice's register above the synchronisation registers of the others: one step of the sum.
  std::uint64_t deskewed() const;
  unsigned slices() const { return static_cast<unsigned>(slices_.size()); }

 private:
  struct Slice {
    std::uint64_t value = 0;
    std::uint64_t carry = 0;  // flip-flop of the carry into this slice; the lowest slice has none, and it stays 0
    unsigned bits = 0;
    unsigned position = 0;                 // of its lowest bit in the word
    std::vector<std::uint64_t> held_back;  // synchronisation registers, newest first
  };
  // Of the adder in this cycle: its bits, and the carry out.
  struct Sum {
    std::uint64_t value = 0;
    std::uint64_t carry = 0;
  };

  CarryClock carry_clock_;
  std::vector<Slice> slices_;
  std::vector<Sum> sums_;
};

}  // namespace rastertlm::object_processor
