#include "modules/host/parameters.h"

#include <fmt/format.h>

namespace rastertlm::host {

void InstructionCycles::declare(parameter::Table& table, const std::string& rate) {
  const auto cycles = [&](const std::string& name, double& target, const std::string& what) {
    table.real("host.instruction." + name, target, {0.0, 1e6},
               {.unit = "cycles",
                .description = "Host clock cycles of " + what + '.',
                .moves = rate,
                .only_when = parameter::Condition{"host.cost", {"instructions"}}});
  };
  cycles("add", add, "a floating-point addition or subtraction");
  cycles("multiply", multiply, "a floating-point multiplication");
  cycles("divide", divide, "a floating-point division");
  cycles("square_root", square_root, "a square root");
  cycles("compare", compare, "a floating-point comparison");
  cycles("convert", convert, "a conversion between integer and floating point");
  cycles("integer", integer, "an integer addition, shift or logical operation");
  cycles("integer_multiply", integer_multiply, "an integer multiplication");
  cycles("operand", operand, "bringing the second operand of an addition, multiplication, division or comparison");
}

void ProcessorParameters::declare(parameter::Table& table, const std::string& rate) {
  declare_model(table, rate);
  declare_speed(table, rate);
  declare_bus(table);
}

void ProcessorParameters::declare_model(parameter::Table& table, const std::string& rate) {
  table.text(
      "host.preset", preset,
      {.unit = "", .description = "Processor of the host: sets the host keys that the file does not.", .moves = rate});
  table.choice("host.cost", cost, {"sustained", "instructions"},
               {.unit = "",
                .description = "What an operation costs: every floating-point operation at the sustained rate, or each "
                               "by the table of instructions.",
                .moves = rate});
}

void ProcessorParameters::declare_speed(parameter::Table& table, const std::string& rate) {
  table.integer(
      "host.clock_hz", clock_hz, {1000, 100'000'000'000},
      {.unit = "Hz", .description = "Clock of the host processors.", .moves = "units[].clock_hz, budgets host"});
  table.real("host.sustained_mflops", sustained_mflops, {0.001, 1e9},
             {.unit = "Mflop/s",
              .description = "Sustained floating-point rate, loads and integer work included.",
              .moves = rate,
              .only_when = parameter::Condition{"host.cost", {"sustained"}}});
  instruction.declare(table, rate);
}

void ProcessorParameters::declare_bus(parameter::Table& table) {
  table.integer("host.bus_bits", bus_bits, {8, 64},
                {.unit = "bits",
                 .description = "Width of the bus to the hardware: a word that is wider takes several.",
                 .moves = "links[] bus, units[] busy"});
  table.integer("host.bus_cycles_per_word", bus_cycles_per_word, {1, 10000},
                {.unit = "cycles",
                 .description = "Host clock cycles of one word written to the hardware.",
                 .moves = "links[] bus, units[] busy"});
}

void HostParameters::declare(parameter::Table& table) {
  const std::string rate = "answer.update_rate_hz";
  declare_model(table, rate);
  table.integer("host.computation_units", computation_units, {1, 16384},
                {.unit = "units",
                 .description = "Computation units, each with an object board of its own.",
                 .moves = "answer.update_rate_hz, modelled.object_processors"});
  table.integer("host.processors_per_unit", processors_per_unit, {1, 1048576},
                {.unit = "processors",
                 .description = "Object processors on a board.",
                 .moves = "modelled.object_processors, decision unit latency"});
  declare_speed(table, rate);
  declare_connections(table);
  declare_policies(table);
}

void HostParameters::declare_connections(parameter::Table& table) {
  declare_bus(table);
  table.integer("host.links", links, {2, 64},
                {.unit = "links",
                 .description = "Serial links of a host processor that the topology uses: one to whoever feeds it.",
                 .moves = "depth of the link tree"});
  table.integer("host.links_available", links_available, {2, 64},
                {.unit = "links",
                 .description = "Serial links that the host processor has.",
                 .moves = "which host.links are accepted"});
  table.choice("host.link_topology", link_topology, {"tree", "chain"},
               {.unit = "",
                .description =
                    "How the animation unit reaches the computation units: store and forward along a tree or a chain.",
                .moves = "units[] starved"});
  table.real("host.link_mbit_per_s", link_mbit_per_s, {0.001, 1e6},
             {.unit = "Mbit/s", .description = "Line rate of a serial link.", .moves = "links[] host links"});
  table.real("host.link_bits_per_byte", link_bits_per_byte, {8.0, 1000.0},
             {.unit = "bits",
              .description = "Bit times that a byte takes, start, stop and acknowledge included.",
              .moves = "links[] host links"});
  table.integer("host.link_packet_bytes", link_packet_bytes, {1, 65536},
                {.unit = "bytes",
                 .description = "Most bytes of a packet on a link.",
                 .moves = "links[] host links, where a packet has bits of its own"});
  table.real("host.link_packet_bits", link_packet_bits, {0.0, 10000.0},
             {.unit = "bits",
              .description = "Bit times that a packet takes beside its bytes: header, end and acknowledge.",
              .moves = "links[] host links"});
  table.integer("host.link_set_up_cycles", link_set_up_cycles, {0, 1'000'000},
                {.unit = "cycles",
                 .description = "Host clock cycles of the processor to start a message on a link.",
                 .moves = "units[] busy"});
}

void HostParameters::declare_policies(parameter::Table& table) {
  table.choice("host.assignment", assignment, {"round_robin", "block"},
               {.unit = "",
                .description = "Object i goes to board i mod B, or boards are filled in turn.",
                .moves = "budgets host, units[] busy"});
  table.choice("host.send", send, {"changed", "all"},
               {.unit = "",
                .description = "Whether coefficients that did not change are computed and written again.",
                .moves = "modelled.coefficients.sent"});
  table.choice(
      "host.overflow", overflow, {"error", "drop"},
      {.unit = "",
       .description = "More objects than processors: refuse, or leave out what found no processor and count it.",
       .moves = "picture, modelled.left_out"});
  table.choice("host.swap", swap, {"global", "unconditional"},
               {.unit = "",
                .description = "Loading RAMs are copied at the first retrace at which every unit has finished, or at "
                               "every retrace, finished or not.",
                .moves = "picture of a late host, images[].torn"});
}

void HostParameters::check(Diagnostics& diagnostics, const std::string& file) const {
  if (links > links_available)
    diagnostics.add({file, 0, "host.links",
                     fmt::format("is {}, and the host processor{} has {} serial links (host.links_available)", links,
                                 preset.empty() ? "" : " " + preset, links_available)});
}

}  // namespace rastertlm::host
