#include "modules/object_processor/microprogram.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

Microinstruction select(Select input) { return {.select = input}; }
Microinstruction ram(RamOperation operation, std::uint8_t address) { return {.ram = operation, .address = address}; }
Microinstruction clocks(std::uint32_t slices) { return {.clocks = slices}; }

std::uint32_t lowest(unsigned slices) { return static_cast<std::uint32_t>(low_mask(slices)); }

}  // namespace

Microprogram frame_start_program() {
  Microprogram program{select(Select::loading_ram)};
  for (std::uint8_t address = 0; address < 3; ++address) {
    program.push_back(ram(RamOperation::read_loading, address));
    program.push_back(ram(RamOperation::write_backup, address));
  }
  program.push_back(select(Select::registers));
  return program;
}

Microprogram line_start_program(unsigned slices) {
  Microprogram program{{.clear = true},
                       ram(RamOperation::read_backup, 2),  // the old value of B y + C
                       clocks(lowest(slices)),             // added to cleared registers: no carry can arise
                       ram(RamOperation::read_backup, 1)};
  for (unsigned slice = 0; slice < slices; ++slice) program.push_back(clocks(std::uint32_t{1} << slice));
  program.push_back(ram(RamOperation::write_backup, 2));  // the new value of B y + C
  program.push_back(ram(RamOperation::read_backup, 0));
  for (unsigned ahead = 1; ahead < slices; ++ahead) program.push_back(clocks(lowest(ahead)));
  return program;
}

Microinstruction pixel_instruction(unsigned slices) { return clocks(lowest(slices)); }

}  // namespace rastertlm::object_processor
