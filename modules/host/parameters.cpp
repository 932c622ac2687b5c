#include "modules/host/parameters.h"

namespace rastertlm::host {

void HostParameters::declare(parameter::Table& table) {
  table.text("host.preset", preset,
             {.unit = "",
              .description = "Processor of the host: sets the host keys that the file does not.",
              .moves = "answer.update_rate_hz"});
  table.choice("host.cost", cost, {"sustained"},
               {.unit = "",
                .description = "What an operation costs: every floating-point operation at the sustained rate.",
                .moves = "answer.update_rate_hz",
                .exempt = true});
  table.integer("host.computation_units", computation_units, {1, 16384},
                {.unit = "units",
                 .description = "Computation units, each with an object board of its own.",
                 .moves = "answer.update_rate_hz, modelled.object_processors"});
  table.integer("host.processors_per_unit", processors_per_unit, {1, 1048576},
                {.unit = "processors",
                 .description = "Object processors on a board.",
                 .moves = "modelled.object_processors, decision unit latency"});
  table.integer(
      "host.clock_hz", clock_hz, {1000, 100'000'000'000},
      {.unit = "Hz", .description = "Clock of the host processors.", .moves = "units[].clock_hz, budgets host"});
  table.real("host.sustained_mflops", sustained_mflops, {0.001, 1e9},
             {.unit = "Mflop/s",
              .description = "Sustained floating-point rate, loads and integer work included.",
              .moves = "answer.update_rate_hz"});
  table.integer("host.bus_cycles_per_word", bus_cycles_per_word, {1, 10000},
                {.unit = "cycles",
                 .description = "Host clock cycles of one word written to a loading RAM.",
                 .moves = "links[] bus, units[] busy"});
  table.integer(
      "host.links", links, {2, 64},
      {.unit = "links", .description = "Serial links of a host processor.", .moves = "depth of the link tree"});
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
  table.integer(
      "host.link_set_up_cycles", link_set_up_cycles, {0, 1'000'000},
      {.unit = "cycles", .description = "Host clock cycles to start a message on a link.", .moves = "units[] starved"});
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
}

}  // namespace rastertlm::host
