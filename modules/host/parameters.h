// The host: an animation unit, and computation units with an object board each.
#pragma once

#include <cstdint>
#include <string>

#include "src/base/errors.h"
#include "src/parameter/table.h"

namespace rastertlm::host {

enum class CostModel { sustained, instructions };
enum class LinkTopology { tree, chain };
enum class Assignment { round_robin, block };
enum class Send { changed, all };
enum class Overflow { error, drop };
// When the boards copy their loading RAMs: at the retrace at which every unit has finished, or at every retrace (004),
// whatever stands in them.
enum class Swap { global, unconditional };

// Cycles of one operation, prefixes included, operands in registers; and what it takes to bring one.
struct InstructionCycles {
  double add = 7.0;
  double multiply = 12.0;
  double divide = 17.0;
  double square_root = 123.0;
  double compare = 5.0;
  double convert = 9.0;
  double integer = 1.0;
  double integer_multiply = 40.0;
  double operand = 5.0;  // of each addition, multiplication, division and comparison: the other stands on the stack

  // `rate`: what moves with them.
  void declare(parameter::Table& table, const std::string& rate);
};

// One processor and its bus: all of the host where there is but one.
struct ProcessorParameters {
  std::string preset = "t800_20";
  CostModel cost = CostModel::sustained;
  std::int64_t clock_hz = 20'000'000;
  double sustained_mflops = 1.5;
  InstructionCycles instruction;
  std::int64_t bus_bits = 32;
  std::int64_t bus_cycles_per_word = 3;

  // Paths "host.preset" ...; `rate` is what moves with its speed.
  void declare(parameter::Table& table, const std::string& rate);

 protected:
  void declare_model(parameter::Table& table, const std::string& rate);
  void declare_speed(parameter::Table& table, const std::string& rate);
  void declare_bus(parameter::Table& table);
};

struct HostParameters : ProcessorParameters {
  std::int64_t computation_units = 8;
  std::int64_t processors_per_unit = 128;
  std::int64_t links = 4;
  std::int64_t links_available = 4;
  LinkTopology link_topology = LinkTopology::tree;
  double link_mbit_per_s = 20.0;
  double link_bits_per_byte = 11.5;
  std::int64_t link_packet_bytes = 32;
  double link_packet_bits = 0.0;
  std::int64_t link_set_up_cycles = 19;
  Assignment assignment = Assignment::round_robin;
  Send send = Send::changed;
  Overflow overflow = Overflow::error;
  Swap swap = Swap::global;

  void declare(parameter::Table& table);
  // What one range cannot say: `file` names the machine file in the diagnostics.
  void check(Diagnostics& diagnostics, const std::string& file) const;

 private:
  void declare_connections(parameter::Table& table);
  void declare_policies(parameter::Table& table);
};

}  // namespace rastertlm::host
