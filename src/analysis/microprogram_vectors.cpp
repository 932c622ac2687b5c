#include "src/analysis/microprogram_vectors.h"

#include <fmt/format.h>

#include <string>

#include "modules/object_processor/microprogram.h"

namespace rastertlm::analysis {
namespace {

using object_processor::Microinstruction;
using object_processor::Microprogram;
using object_processor::RamOperation;
using object_processor::Select;

const char* name(Select select) {
  switch (select) {
    case Select::loading_ram:
      return "loading_ram";
    case Select::registers:
      return "registers";
    default:
      return "";
  }
}

const char* name(RamOperation operation) {
  switch (operation) {
    case RamOperation::read_loading:
      return "read_loading";
    case RamOperation::read_backup:
      return "read_backup";
    case RamOperation::write_backup:
      return "write_backup";
    default:
      return "";
  }
}

std::string rows(const std::string& program, const Microprogram& steps, unsigned slices) {
  constexpr std::string_view kAddresses = "ABC";
  std::string text;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const Microinstruction& instruction = steps[step];
    const bool addressed = instruction.ram != RamOperation::none;
    text +=
        fmt::format("{},{},{},{},{},{},{:0{}b}\n", program, step, name(instruction.select), instruction.clear ? 1 : 0,
                    name(instruction.ram), addressed ? kAddresses.substr(instruction.address, 1) : std::string_view(),
                    instruction.clocks, slices);
  }
  return text;
}

}  // namespace

void write_microprogram(unsigned slices, VectorFiles& files) {
  files.write("microprogram.csv", "program,step,select,clear,ram,address,clocks\n" +
                                      rows("frame_start", object_processor::frame_start_program(), slices) +
                                      rows("line_start", object_processor::line_start_program(slices), slices) +
                                      rows("pixel", {object_processor::pixel_instruction(slices)}, slices));
}

}  // namespace rastertlm::analysis
