#include "modules/object_processor/second_order_program.h"

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

namespace {

using Word = SecondOrderWord;

SecondOrderInstruction select(Select input) { return {.select = input}; }
SecondOrderInstruction read(Word word) { return {.ram = RamOperation::read_backup, .word = word}; }
SecondOrderInstruction write(Word word, bool from_d) {
  return {.ram = RamOperation::write_backup, .word = word, .from_d = from_d};
}
SecondOrderInstruction clear_both() { return {.clear_v = true, .clear_d = true}; }
// From the RAM's output.
SecondOrderInstruction add_to_v(std::uint32_t clocks) { return {.clocks_v = clocks}; }
SecondOrderInstruction add_to_d(std::uint32_t clocks) { return {.clocks_d = clocks}; }

std::uint32_t lowest(unsigned slices) { return static_cast<std::uint32_t>(low_mask(slices)); }

}  // namespace

SecondOrderProgram second_order_frame_start() {
  SecondOrderProgram program{select(Select::loading_ram)};
  for (std::size_t address = 0; address < kSecondOrderWords; ++address) {
    const auto word = static_cast<Word>(address);
    program.push_back({.ram = RamOperation::read_loading, .word = word});
    program.push_back({.ram = RamOperation::write_backup, .word = word});
  }
  program.push_back(select(Select::registers));
  return program;
}

SecondOrderProgram second_order_line_start(unsigned slices) {
  SecondOrderProgram program{clear_both(),   read(Word::v0),           add_to_v(lowest(slices)),
                             read(Word::d0), add_to_d(lowest(slices)), read(Word::two_a)};
  for (unsigned ahead = 1; ahead < slices; ++ahead)
    program.push_back({.v_takes_d = true, .clocks_v = lowest(ahead), .clocks_d = lowest(ahead)});
  return program;
}

SecondOrderProgram second_order_line_step(unsigned slices) {
  SecondOrderProgram program{clear_both(), read(Word::v0), add_to_v(lowest(slices)), read(Word::dy)};
  // A sum ripples through the slices, one a cycle; D, cleared, takes Dy whole beside the first.
  for (unsigned slice = 0; slice < slices; ++slice)
    program.push_back({.clocks_v = std::uint32_t{1} << slice, .clocks_d = slice == 0 ? lowest(slices) : 0});
  program.push_back(write(Word::v0, false));
  program.push_back(read(Word::two_b));
  for (unsigned slice = 0; slice < slices; ++slice) program.push_back(add_to_d(std::uint32_t{1} << slice));
  program.push_back(write(Word::dy, true));
  program.push_back({.clear_d = true});
  program.push_back(read(Word::d0));
  program.push_back(add_to_d(lowest(slices)));
  program.push_back(read(Word::c));
  for (unsigned slice = 0; slice < slices; ++slice) program.push_back(add_to_d(std::uint32_t{1} << slice));
  program.push_back(write(Word::d0, true));
  return program;
}

SecondOrderInstruction second_order_pixel(unsigned slices) {
  return {.v_takes_d = true, .clocks_v = lowest(slices), .clocks_d = lowest(slices)};
}

}  // namespace rastertlm::object_processor
