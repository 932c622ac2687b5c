#include "modules/host/cost_model.h"

#include <cmath>

namespace rastertlm::host {
namespace {

// A product that is whole but for its rounding is that number of cycles.
Cycles up(double cycles) { return Cycles(static_cast<std::uint64_t>(std::ceil(cycles - 1e-6))); }

std::uint64_t count(std::int64_t value) { return static_cast<std::uint64_t>(value); }

}  // namespace

HostCost::HostCost(const HostParameters& parameters, std::int64_t coefficient_bits)
    : parameters_(parameters),
      clock_(Clock::from_frequency_hz("host clock", count(parameters.clock_hz))),
      cycles_per_flop_(static_cast<double>(parameters.clock_hz) / (parameters.sustained_mflops * 1e6)),
      bus_words_a_word_(count((coefficient_bits + parameters.bus_bits - 1) / parameters.bus_bits)),
      word_(bus_words_a_word_ * count(parameters.bus_cycles_per_word)),
      cycles_per_bit_(static_cast<double>(parameters.clock_hz) / (parameters.link_mbit_per_s * 1e6)),
      link_set_up_(count(parameters.link_set_up_cycles)) {}

double HostCost::cycles(const geometry::OperationCounts& counts) const {
  if (parameters_.cost == CostModel::sustained) return static_cast<double>(counts.flops()) * cycles_per_flop_;
  const InstructionCycles& each = parameters_.instruction;
  const auto times = [](std::uint64_t operations, double cost) { return static_cast<double>(operations) * cost; };
  return times(counts.add, each.add) + times(counts.multiply, each.multiply) + times(counts.divide, each.divide) +
         times(counts.square_root, each.square_root) + times(counts.compare, each.compare) +
         times(counts.convert, each.convert) + times(counts.integer, each.integer) +
         times(counts.integer_multiply, each.integer_multiply) +
         times(counts.add + counts.multiply + counts.divide + counts.compare, each.operand);
}

Cycles HostCost::compute(const geometry::OperationCounts& counts) const { return up(cycles(counts)); }

double HostCost::cycles_per_flop(const geometry::OperationCounts& counts) const {
  if (parameters_.cost == CostModel::sustained) return cycles_per_flop_;
  return counts.flops() == 0 ? 0.0 : cycles(counts) / static_cast<double>(counts.flops());
}

double HostCost::link_bits(std::uint64_t bytes) const {
  const std::uint64_t packet = count(parameters_.link_packet_bytes);
  const std::uint64_t packets = (bytes + packet - 1) / packet;
  return static_cast<double>(bytes) * parameters_.link_bits_per_byte +
         static_cast<double>(packets) * parameters_.link_packet_bits;
}

Cycles HostCost::transfer(std::uint64_t bytes) const { return up(link_bits(bytes) * cycles_per_bit_); }

Cycles HostCost::link_cycles(std::uint64_t bytes) const { return up(link_bits(bytes) / link_bits_per_byte()); }

double HostCost::link_bits_per_byte() const {
  return parameters_.link_bits_per_byte +
         parameters_.link_packet_bits / static_cast<double>(parameters_.link_packet_bytes);
}

}  // namespace rastertlm::host
