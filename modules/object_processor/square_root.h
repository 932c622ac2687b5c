// The square-root extractor of a quadric processor: a pipeline of one stage a result bit, which takes an EP2's word
// each clock and gives the root of an earlier one. The papers name it and print nothing of it: digit by digit, with a
// subtracter a stage, is ours.
#pragma once

#include <cstdint>
#include <vector>

namespace rastertlm::object_processor {

// How a root that lies between two words is read.
enum class RootReading {
  floor,     // as its word: up to 1 unit too small
  half_unit  // as the middle of its interval: one bit more, always 1
};

// The root of V, a word of `fraction_bits`, has integer_bits + guard_bits bits, guard_bits of them fraction.
struct RootFormat {
  unsigned integer_bits = 9;    // of the root
  unsigned guard_bits = 6;      // integer_bits + guard_bits in 1..32
  unsigned fraction_bits = 12;  // of the radicand
  RootReading reading = RootReading::half_unit;

  unsigned result_bits() const { return integer_bits + guard_bits; }
  unsigned stages() const { return result_bits(); }  // of the pipeline: its latency in clocks
  // Of the result's integer: the half unit is one more.
  unsigned read_fraction_bits() const { return guard_bits + (reading == RootReading::half_unit ? 1 : 0); }
  // The radicand as the stages take it, 2 result_bits bits with 2 guard_bits of fraction: low bits are dropped, or
  // zeros joined. `word` is not negative; bits above are lost, as in the machine.
  std::uint64_t radicand(std::uint64_t word) const;
  // Whether a word's root has a place in the result: words from 0 to the largest.
  std::uint64_t largest_word() const;
};

// What goes from one stage to the next.
struct RootStage {
  std::uint64_t radicand = 0;  // bits that no stage has taken yet, at the top of 2 result_bits
  std::uint64_t remainder = 0;
  std::uint64_t root = 0;  // bits found so far
};

// One stage: takes the two highest bits of the radicand, finds one bit of the root.
RootStage next_root_bit(const RootStage& stage, unsigned result_bits);

// floor(sqrt(V 2^(2 guard_bits))) for V = word / 2^fraction_bits, or twice that plus 1: what leaves the last stage, as
// it is read, with read_fraction_bits of fraction.
std::uint64_t square_root(std::uint64_t word, const RootFormat& format);

// The pipeline, register by register.
class RootPipeline {
 public:
  explicit RootPipeline(const RootFormat& format);
  // One clock: `word` enters. Returns what has just left the last stage: the root of the word of stages() - 1 clocks
  // before.
  std::uint64_t clock(std::uint64_t word);
  // Bits of all its registers: what each stage keeps.
  std::uint64_t register_bits() const;

 private:
  RootFormat format_;
  std::vector<RootStage> stages_;
};

}  // namespace rastertlm::object_processor
