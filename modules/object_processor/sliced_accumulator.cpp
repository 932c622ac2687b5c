#include "modules/object_processor/sliced_accumulator.h"

#include <algorithm>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

SlicedAccumulator::SlicedAccumulator(unsigned word_bits, unsigned slice_bits, CarryClock carry_clock)
    : carry_clock_(carry_clock) {
  const unsigned count = (word_bits + slice_bits - 1) / slice_bits;
  slices_.resize(count);
  sums_.resize(count);
  for (unsigned i = 0; i < count; ++i) {
    slices_[i].position = i * slice_bits;
    slices_[i].bits = std::min(slice_bits, word_bits - slices_[i].position);
    slices_[i].held_back.resize(count - 1 - i);
  }
}

void SlicedAccumulator::clear() {
  for (Slice& slice : slices_) {
    slice.value = slice.carry = 0;
    std::fill(slice.held_back.begin(), slice.held_back.end(), std::uint64_t{0});
  }
}

void SlicedAccumulator::clock(std::uint64_t addend, std::uint32_t clocks) {
  // 1. The adders, from what the registers hold before the edge. A sum of 64 bits has its carry apart.
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    const Slice& slice = slices_[i];
    const std::uint64_t mask = low_mask(slice.bits);
    const std::uint64_t bits = (addend >> slice.position) & mask;
    const std::uint64_t low = (slice.value + bits + slice.carry) & mask;
    sums_[i] = {low, low < bits || (low == bits && (slice.value != 0 || slice.carry != 0)) ? 1U : 0U};
  }
  // 2. The edge.
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    const bool clocked = (clocks >> i & 1U) != 0;
    Slice& slice = slices_[i];
    if (clocked) {
      if (!slice.held_back.empty()) {
        std::shift_right(slice.held_back.begin(), slice.held_back.end(), 1);
        slice.held_back.front() = slice.value;
      }
      slice.value = sums_[i].value;
    }
    const bool carry_clocked =
        carry_clock_ == CarryClock::clock1 ? i > 0 && (clocks >> (i - 1) & 1U) != 0 : i > 0 && clocked;
    if (carry_clocked) slice.carry = sums_[i - 1].carry;
  }
}

std::uint64_t SlicedAccumulator::word() const {
  std::uint64_t word = 0;
  for (const Slice& slice : slices_) word |= slice.value << slice.position;
  return word;
}

std::uint64_t SlicedAccumulator::deskewed() const {
  std::uint64_t word = 0;
  for (const Slice& slice : slices_)
    word |= (slice.held_back.empty() ? slice.value : slice.held_back.back()) << slice.position;
  return word;
}

}  // namespace rastertlm::object_processor
