// What work costs a host processor, in cycles of its clock.
#pragma once

#include <cmath>
#include <cstdint>

#include "modules/host/parameters.h"
#include "src/base/units.h"
#include "src/geometry/counted.h"

namespace rastertlm::host {

// Cycles are rounded up a piece of work, never a single operation.
class HostCost {
 public:
  explicit HostCost(const HostParameters& parameters)
      : clock_(Clock::from_frequency_hz("host clock", static_cast<std::uint64_t>(parameters.clock_hz))),
        cycles_per_flop_(static_cast<double>(parameters.clock_hz) / (parameters.sustained_mflops * 1e6)),
        bus_cycles_per_word_(static_cast<std::uint64_t>(parameters.bus_cycles_per_word)),
        link_cycles_per_byte_(static_cast<double>(parameters.clock_hz) * parameters.link_bits_per_byte /
                              (parameters.link_mbit_per_s * 1e6)),
        link_set_up_(static_cast<std::uint64_t>(parameters.link_set_up_cycles)) {}

  const Clock& clock() const { return clock_; }
  // Sustained: every floating-point operation costs clock / rate cycles, integer work and loads included.
  Cycles compute(const geometry::OperationCounts& counts) const {
    return up(static_cast<double>(counts.flops()) * cycles_per_flop_);
  }
  Cycles bus(std::uint64_t words) const { return Cycles(words * bus_cycles_per_word_); }
  // A message of `bytes` from one processor to the next.
  Cycles message(std::uint64_t bytes) const {
    return Cycles(link_set_up_) + up(static_cast<double>(bytes) * link_cycles_per_byte_);
  }
  double cycles_per_flop() const { return cycles_per_flop_; }

 private:
  static Cycles up(double cycles) { return Cycles(static_cast<std::uint64_t>(std::ceil(cycles - 1e-6))); }

  Clock clock_;
  double cycles_per_flop_;
  std::uint64_t bus_cycles_per_word_;
  double link_cycles_per_byte_;
  std::uint64_t link_set_up_;
};

}  // namespace rastertlm::host
