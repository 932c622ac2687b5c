// The second order elementary processor, EP2 (004, section 5.2.1), register by register: two adders, two registers, six
// words.
//
// During the pixel cycle of column x on line y (both from 0) the output is A x^2 + B y^2 + C x y + D x + E y + F modulo
// 2^word_bits; a pixel is inside where its sign bit is 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "modules/object_processor/second_order_program.h"
#include "modules/object_processor/sliced_accumulator.h"

namespace rastertlm::object_processor {

// Words of word_bits, two's complement, as the host loads them.
struct SecondOrderWords {
  std::uint64_t v0 = 0;     // F
  std::uint64_t dy = 0;     // B + E
  std::uint64_t two_b = 0;  // 2 B
  std::uint64_t d0 = 0;     // A + D
  std::uint64_t c = 0;      // C
  std::uint64_t two_a = 0;  // 2 A
  friend bool operator==(const SecondOrderWords&, const SecondOrderWords&) = default;
};

// The output at column x of line y in closed form, modulo 2^word_bits (1..64): equal to the microprogram's, wrapping
// included.
std::uint64_t second_order_value(const SecondOrderWords& words, std::uint64_t x, std::uint64_t y, unsigned word_bits);

class SecondOrderProcessor {
 public:
  // word_bits 2..64, slice_bits 1..word_bits, at most 32 slices. RAMs and registers start at zero.
  SecondOrderProcessor(unsigned word_bits, unsigned slice_bits, CarryClock carry_clock = CarryClock::clock1);

  void load(const SecondOrderWords& words);  // the loading RAM
  std::uint64_t backup(SecondOrderWord word) const { return backup_.at(static_cast<std::size_t>(word)); }
  unsigned slices() const { return v_.slices(); }

  // One cycle; what is clocked changes at its end.
  void step(const SecondOrderInstruction& instruction);
  void run(const SecondOrderProgram& program);

  // To be read before the cycle's step.
  std::uint64_t output() const { return v_.deskewed(); }

 private:
  void access_ram(const SecondOrderInstruction& instruction);

  std::uint64_t word_mask_;
  bool from_loading_ = false;
  std::array<std::uint64_t, kSecondOrderWords> loading_{};
  std::array<std::uint64_t, kSecondOrderWords> backup_{};
  std::uint64_t ram_output_ = 0;
  SlicedAccumulator v_;
  SlicedAccumulator d_;
};

}  // namespace rastertlm::object_processor
