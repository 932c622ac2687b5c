#include "modules/pixel_unit/parameters.h"

#include <string>

namespace rastertlm::pixel_unit {

using parameter::About;
using parameter::Condition;

namespace {

const Condition kShaded{"set_up.method", {"phong", "gouraud_phong", "duff", "taylor", "angular"}};

}  // namespace

void PixelUnitParameters::declare(parameter::Table& table) {
  const std::string rate = "answer.frame_rate_hz, units[] pixel unit";
  table.real("pixel_unit.clock_ns", clock_ns, {0.1, 1e6}, About{"ns", "Clock of the pixel unit.", rate, kShaded});
  table.integer("pixel_unit.cycles_per_pixel", cycles_per_pixel, {1, 10000},
                About{"cycles", "From a pixel to the next: the initiation interval.", rate, kShaded});
  table.integer("pixel_unit.latency_cycles", latency_cycles, {1, 10000},
                About{"cycles", "From a triangle's first pixel to its levels.", rate, kShaded});
  table.integer("pixel_unit.cycles_per_line", cycles_per_line, {0, 10000},
                About{"cycles", "From a line to its first pixel: what the method starts anew.", rate, kShaded});
  table.integer("pixel_unit.load_cycles", load_cycles, {0, 10000},
                About{"cycles", "From a triangle to its first line.", rate, kShaded});
}

}  // namespace rastertlm::pixel_unit
