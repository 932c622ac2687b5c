#include "modules/object_processor/second_order_processor.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

// n (n - 1) / 2 modulo 2^64.
std::uint64_t pairs(std::uint64_t n) { return n % 2 == 0 ? n / 2 * (n - 1) : n * ((n - 1) / 2); }

}  // namespace

std::uint64_t second_order_value(const SecondOrderWords& words, std::uint64_t x, std::uint64_t y, unsigned word_bits) {
  const std::uint64_t start = words.v0 + y * words.dy + pairs(y) * words.two_b;
  const std::uint64_t step = words.d0 + y * words.c;
  return (start + x * step + pairs(x) * words.two_a) & low_mask(word_bits);
}

SecondOrderProcessor::SecondOrderProcessor(unsigned word_bits, unsigned slice_bits, CarryClock carry_clock)
    : word_mask_(low_mask(word_bits)), v_(word_bits, slice_bits, carry_clock), d_(word_bits, slice_bits, carry_clock) {}

void SecondOrderProcessor::load(const SecondOrderWords& words) {
  loading_ = {words.v0, words.dy, words.two_b, words.d0, words.c, words.two_a};
  for (std::uint64_t& word : loading_) word &= word_mask_;
}

void SecondOrderProcessor::access_ram(const SecondOrderInstruction& instruction) {
  const auto address = static_cast<std::size_t>(instruction.word);
  switch (instruction.ram) {
    case RamOperation::none:
      break;
    case RamOperation::read_loading:
      ram_output_ = loading_.at(address);
      break;
    case RamOperation::read_backup:
      ram_output_ = backup_.at(address);
      break;
    case RamOperation::write_backup:
      backup_.at(address) = from_loading_ ? ram_output_ : (instruction.from_d ? d_ : v_).word();
      break;
  }
}

void SecondOrderProcessor::step(const SecondOrderInstruction& instruction) {
  if (instruction.select != Select::unchanged) from_loading_ = instruction.select == Select::loading_ram;
  access_ram(instruction);
  if (instruction.clear_v) v_.clear();
  if (instruction.clear_d) d_.clear();
  const std::uint64_t d = d_.word();  // before the edge
  if (instruction.clocks_v != 0) v_.clock(instruction.v_takes_d ? d : ram_output_, instruction.clocks_v);
  if (instruction.clocks_d != 0) d_.clock(ram_output_, instruction.clocks_d);
}

void SecondOrderProcessor::run(const SecondOrderProgram& program) {
  for (const SecondOrderInstruction& instruction : program) step(instruction);
}

}  // namespace rastertlm::object_processor
