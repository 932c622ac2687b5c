// The host: an animation unit, and computation units with an object board each.
#pragma once

#include <cstdint>
#include <string>

#include "src/parameter/table.h"

namespace rastertlm::host {

enum class CostModel { sustained };
enum class LinkTopology { tree, chain };
enum class Assignment { round_robin, block };
enum class Send { changed, all };
enum class Overflow { error, drop };

struct HostParameters {
  std::string preset = "t800_20";
  CostModel cost = CostModel::sustained;
  std::int64_t computation_units = 8;
  std::int64_t processors_per_unit = 128;
  std::int64_t clock_hz = 20'000'000;
  double sustained_mflops = 1.5;
  std::int64_t bus_cycles_per_word = 3;
  std::int64_t links = 4;
  LinkTopology link_topology = LinkTopology::tree;
  double link_mbit_per_s = 20.0;
  double link_bits_per_byte = 11.5;
  std::int64_t link_set_up_cycles = 19;
  Assignment assignment = Assignment::round_robin;
  Send send = Send::changed;
  Overflow overflow = Overflow::error;

  void declare(parameter::Table& table);
};

}  // namespace rastertlm::host
