// What work costs a host processor, in cycles of its clock.
#pragma once

#include <cstdint>

#include "modules/host/parameters.h"
#include "src/base/units.h"
#include "src/geometry/counted.h"

namespace rastertlm::host {

// Cycles are rounded up a piece of work, never a single operation.
class HostCost {
 public:
  // `coefficient_bits`: width of what is written to a loading RAM.
  explicit HostCost(const HostParameters& parameters, std::int64_t coefficient_bits = 24);

  const Clock& clock() const { return clock_; }
  // Sustained: every floating-point operation costs clock / rate cycles, integer work and loads included. By
  // instructions: each operation its own, and its operand.
  Cycles compute(const geometry::OperationCounts& counts) const;
  // `words`: coefficients and material words; each takes word() on the bus.
  Cycles bus(std::uint64_t words) const { return word_ * words; }
  Cycles word() const { return word_; }
  std::uint64_t bus_words(std::uint64_t words) const { return words * bus_words_a_word_; }
  // Of words of several widths: what they are on the bus, and the time that takes.
  std::uint64_t bus_bits() const { return static_cast<std::uint64_t>(parameters_.bus_bits); }
  Cycles bus_transfer(std::uint64_t bus_words) const {
    return Cycles(bus_words * static_cast<std::uint64_t>(parameters_.bus_cycles_per_word));
  }
  // What the sender's processor spends to start a message.
  Cycles link_set_up() const { return link_set_up_; }
  // A message of `bytes` on its way from one processor to the next.
  Cycles transfer(std::uint64_t bytes) const;
  // Bit times a byte, in full packets: a link's bytes take no less.
  double link_bits_per_byte() const;
  // A message in cycles of a clock that ticks once in link_bits_per_byte() bit times, rounded up.
  Cycles link_cycles(std::uint64_t bytes) const;
  // The mean of the operations counted, by this model.
  double cycles_per_flop(const geometry::OperationCounts& counts) const;

 private:
  double cycles(const geometry::OperationCounts& counts) const;
  double link_bits(std::uint64_t bytes) const;

  HostParameters parameters_;
  Clock clock_;
  double cycles_per_flop_;  // sustained
  std::uint64_t bus_words_a_word_;
  Cycles word_;
  double cycles_per_bit_;
  Cycles link_set_up_;
};

}  // namespace rastertlm::host
