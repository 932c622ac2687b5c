#include "modules/object_processor/elementary_processor.h"

#include <algorithm>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

ElementaryProcessor::ElementaryProcessor(const ObjectProcessorParameters& parameters)
    : word_mask_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.word_bits)))),
      carry_clock_(parameters.carry_clock) {
  const unsigned count = parameters.slices();
  slices_.resize(count);
  sums_.resize(count);
  for (unsigned i = 0; i < count; ++i) {
    const unsigned position = i * static_cast<unsigned>(parameters.slice_bits);
    slices_[i].position = position;
    slices_[i].bits =
        std::min(static_cast<unsigned>(parameters.slice_bits), static_cast<unsigned>(parameters.word_bits) - position);
    slices_[i].held_back.resize(count - 1 - i);
  }
}

std::uint32_t ElementaryProcessor::addend(const Slice& slice) const {
  return (ram_output_ >> slice.position) & static_cast<std::uint32_t>(low_mask(slice.bits));
}

std::uint32_t ElementaryProcessor::registers() const {
  std::uint32_t word = 0;
  for (const Slice& slice : slices_) word |= slice.value << slice.position;
  return word;
}

std::uint32_t ElementaryProcessor::output() const {
  std::uint32_t word = 0;
  for (const Slice& slice : slices_)
    word |= (slice.held_back.empty() ? slice.value : slice.held_back.back()) << slice.position;
  return word;
}

void ElementaryProcessor::clock(std::uint32_t clocks) {
  // 1. The adders, from what the registers hold before the edge.
  for (std::size_t i = 0; i < slices_.size(); ++i)
    sums_[i] = std::uint64_t{slices_[i].value} + addend(slices_[i]) + slices_[i].carry;
  // 2. The edge.
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    const bool clocked = (clocks >> i & 1U) != 0;
    Slice& slice = slices_[i];
    if (clocked) {
      if (!slice.held_back.empty()) {
        std::shift_right(slice.held_back.begin(), slice.held_back.end(), 1);
        slice.held_back.front() = slice.value;
      }
      slice.value = static_cast<std::uint32_t>(sums_[i] & low_mask(slice.bits));
    }
    const bool carry_clocked =
        carry_clock_ == CarryClock::clock1 ? i > 0 && (clocks >> (i - 1) & 1U) != 0 : i > 0 && clocked;
    if (carry_clocked) slice.carry = static_cast<std::uint32_t>(sums_[i - 1] >> slices_[i - 1].bits);
  }
}

void ElementaryProcessor::access_ram(const Microinstruction& instruction) {
  switch (instruction.ram) {
    case RamOperation::none:
      break;
    case RamOperation::read_loading:
      ram_output_ = loading_.at(instruction.address);
      break;
    case RamOperation::read_backup:
      ram_output_ = backup_.at(instruction.address);
      break;
    case RamOperation::write_backup:
      backup_.at(instruction.address) = from_loading_ ? ram_output_ : registers();
      break;
  }
}

void ElementaryProcessor::step(const Microinstruction& instruction) {
  if (instruction.select != Select::unchanged) from_loading_ = instruction.select == Select::loading_ram;
  access_ram(instruction);
  if (instruction.clear) {
    for (Slice& slice : slices_) {
      slice.value = slice.carry = 0;
      std::fill(slice.held_back.begin(), slice.held_back.end(), 0U);
    }
  }
  if (instruction.clocks != 0) clock(instruction.clocks);
}

void ElementaryProcessor::run(const Microprogram& program) {
  for (const Microinstruction& instruction : program) step(instruction);
}

}  // namespace rastertlm::object_processor
