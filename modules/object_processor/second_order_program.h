// The microprogram of the second order elementary processor, EP2, as data. The papers print EP1's alone; this one is
// ours, by the same rules: one listed line is one cycle, a read latches the RAM's output, adders are cut into slices.
//
// Six words: V0, Dy, 2B, D0, C, 2A. Two accumulators, V and D, whose adders take the RAM's output, V's also D. For
// V = A x^2 + B y^2 + C x y + D x + E y + F the host loads V0 = F, Dy = B + E, D0 = A + D of line 0:
//   pixel                          V += D, D += 2A
//   line start   n + 5 cycles      V = V0, D = D0, 2A at the adder of D; n - 1 clocks that fill the skew of n slices
//   line step    3 n + 12 cycles   V0 += Dy, Dy += 2B, D0 += C: before every line but the first
// EP2 shows line y, where EP1 shows line y + 1.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/object_processor/microprogram.h"
#include "src/base/units.h"

namespace rastertlm::object_processor {

// The words of an EP2 in the order of their addresses.
enum class SecondOrderWord : std::uint8_t { v0, dy, two_b, d0, c, two_a };
inline constexpr std::size_t kSecondOrderWords = 6;

// One cycle. The input of the backup RAM is the loading RAM or, as `from_d` says, one of the accumulators.
struct SecondOrderInstruction {
  Select select = Select::unchanged;
  RamOperation ram = RamOperation::none;
  SecondOrderWord word = SecondOrderWord::v0;
  bool from_d = false;
  bool clear_v = false;
  bool clear_d = false;
  bool v_takes_d = false;      // else the RAM's output
  std::uint32_t clocks_v = 0;  // bit i clocks slice i
  std::uint32_t clocks_d = 0;
};

using SecondOrderProgram = std::vector<SecondOrderInstruction>;

SecondOrderProgram second_order_frame_start();
SecondOrderProgram second_order_line_start(unsigned slices);  // slices in 1..32
SecondOrderProgram second_order_line_step(unsigned slices);
SecondOrderInstruction second_order_pixel(unsigned slices);

// Closed forms of their lengths.
constexpr Cycles second_order_frame_start_cycles() { return Cycles(14); }
// Where `lines` lie between the line shown before and this one: 1, or 2 of interlaced video; 0 for the first.
constexpr Cycles second_order_line_cycles(unsigned slices, std::uint64_t lines) {
  return Cycles(slices + 5 + lines * (3 * std::uint64_t{slices} + 12));
}

}  // namespace rastertlm::object_processor
