// The microprogram of the first order elementary processor (004, section 5.2.2) as data. One listed line is one cycle;
// "Clock1, Clock2" on one line are simultaneous.
//
// The paper's adder has two slices. With n slices each lags the one below it by a clock: the sum V + B takes n cycles,
// one slice after another, and before the first pixel slice i is clocked n - 1 - i times ahead of the highest, its
// values held back by as many synchronisation registers. A line start is then: clear, read V, clock all, read B, n
// single clocks, write V, read A, n - 1 clocks that fill the skew: 2 n + 5 cycles. n = 2 is the paper's 9, n = 1 has no
// skew and takes 7.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/object_processor/parameters.h"
#include "src/base/units.h"

namespace rastertlm::object_processor {

// What the input of the backup RAM is connected to.
enum class Select : std::uint8_t { unchanged, loading_ram, registers };
enum class RamOperation : std::uint8_t { none, read_loading, read_backup, write_backup };

// One cycle. A read latches the RAM's output, which stays until the next read.
struct Microinstruction {
  Select select = Select::unchanged;
  bool clear = false;  // all registers and carry flip-flops
  RamOperation ram = RamOperation::none;
  std::uint8_t address = 0;  // 0..2: A, B, C
  std::uint32_t clocks = 0;  // bit i clocks slice i (bit 0: the paper's clock1, bit 1: clock2)
};

using Microprogram = std::vector<Microinstruction>;

Microprogram frame_start_program();
Microprogram line_start_program(unsigned slices);  // slices in 1..32
Microinstruction pixel_instruction(unsigned slices);

// Closed forms of their lengths.
constexpr Cycles frame_start_cycles() { return Cycles(8); }
constexpr Cycles line_start_cycles(unsigned slices) { return Cycles(2 * std::uint64_t{slices} + 5); }
// Where the next line shown is not the next of the picture (interlaced video), B y + C goes on by running the program
// once for each line that it passes. The papers do not say how; so no word, register or adder is added, and the host's
// words are those of any other screen.
constexpr Cycles line_start_cycles(unsigned slices, std::uint64_t lines) { return line_start_cycles(slices) * lines; }
constexpr Cycles pixel_cycles() { return Cycles(1); }

}  // namespace rastertlm::object_processor
