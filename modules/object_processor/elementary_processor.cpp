#include "modules/object_processor/elementary_processor.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

ElementaryProcessor::ElementaryProcessor(const ObjectProcessorParameters& parameters)
    : word_mask_(static_cast<std::uint32_t>(low_mask(static_cast<unsigned>(parameters.word_bits)))),
      sum_(static_cast<unsigned>(parameters.word_bits), static_cast<unsigned>(parameters.slice_bits),
           parameters.carry_clock) {}

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
      backup_.at(instruction.address) = from_loading_ ? ram_output_ : static_cast<std::uint32_t>(sum_.word());
      break;
  }
}

void ElementaryProcessor::step(const Microinstruction& instruction) {
  if (instruction.select != Select::unchanged) from_loading_ = instruction.select == Select::loading_ram;
  access_ram(instruction);
  if (instruction.clear) sum_.clear();
  if (instruction.clocks != 0) sum_.clock(ram_output_, instruction.clocks);
}

void ElementaryProcessor::run(const Microprogram& program) {
  for (const Microinstruction& instruction : program) step(instruction);
}

}  // namespace rastertlm::object_processor
