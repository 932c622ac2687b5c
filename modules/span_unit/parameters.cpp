#include "modules/span_unit/parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace rastertlm::span_unit {

using parameter::About;
using parameter::Condition;

void SpanUnitParameters::declare(parameter::Table& table) {
  const std::string picture = "the picture";
  const std::string rate = "answer.frame_rate_hz, units[] span unit";
  table.real("span_unit.clock_ns", clock_ns, {0.1, 1e6}, About{"ns", "Clock of the span unit.", rate});
  table.integer("span_unit.word_bits", word_bits, {12, 40},
                About{"bits", "Word of the colour registers, two's complement, wrapping.", picture + ", logic"});
  table.integer("span_unit.fraction_bits", fraction_bits, {0, 30},
                About{"bits", "Fraction bits of the colour registers.", picture});
  table.integer("span_unit.depth_bits", depth_bits, {8, 32},
                About{"bits", "Depth word that is compared and stored.", picture + ", memories[] frame store"});
  table.integer("span_unit.depth_fraction_bits", depth_fraction_bits, {0, 24},
                About{"bits", "Fraction bits of the depth registers below the word.", picture});
  table.choice("span_unit.start_edge", start_edge, {"lattice", "prestep", "published"},
               About{"", "How the registers of a line's first pixel follow the start edge.", picture});
  table.integer("span_unit.prestep_bits", prestep_bits, {1, 16},
                About{"bits", "Fraction of the distance to the first pixel that is multiplied in.", picture,
                      Condition{"span_unit.start_edge", {"prestep"}}});
  table.choice("span_unit.carry", carry, {"rank", "clock"},
               About{"", "A carrying line takes a second rank of adders, or one more clock.", "logic, " + rate,
                     Condition{"span_unit.start_edge", {"lattice"}}});
  table.integer("span_unit.pixel_cycles", pixel_cycles, {1, 1000}, About{"cycles", "Clocks of a pixel.", rate});
  table.integer("span_unit.load_cycles", load_cycles, {0, 10000},
                About{"cycles", "Clocks from a load to its first pixel.", rate});
  table.integer("span_unit.line_change_cycles", line_change_cycles, {0, 10000},
                About{"cycles", "Clocks lost from a line to the next.", rate});
  table.integer("span_unit.shadow_sets", shadow_sets, {0, 1024},
                About{"sets", "Register sets that the next triangles are written to while one is drawn.", rate});
  table.integer("span_unit.units", units, {1, 64}, About{"units", "Span units.", rate});
  table.choice("span_unit.share", share, {"triangles", "columns"},
               About{"", "Several units: triangles are dealt, or columns interleaved.", rate});
}

void SpanUnitParameters::check(const std::string& file, Diagnostics& diagnostics) const {
  if (fraction_bits + kIntegerBits > word_bits)
    diagnostics.add({file, 0, "span_unit.fraction_bits",
                     fmt::format("{} fraction bits and {} for sign, guard and level are more than span_unit.word_bits, "
                                 "{}; at most {} are accepted",
                                 fraction_bits, kIntegerBits, word_bits, word_bits - kIntegerBits)});
  if (depth_bits + depth_fraction_bits > kDepthRegister)
    diagnostics.add({file, 0, "span_unit.depth_fraction_bits",
                     fmt::format("{} bits of depth and {} below them are more than the {} of a depth "
                                 "register; at most {} are accepted",
                                 depth_bits, depth_fraction_bits, kDepthRegister, kDepthRegister - depth_bits)});
}

double fraction_bound(std::int64_t fraction_bits, std::uint64_t steps) {
  const auto k = static_cast<double>(steps);
  return std::ldexp((k * k + k + 2) / 2, -static_cast<int>(fraction_bits) - 1);
}

double linear_fraction_bound(std::int64_t fraction_bits, std::uint64_t steps) {
  return std::ldexp(static_cast<double>(steps) + 1, -static_cast<int>(fraction_bits) - 1);
}

std::uint64_t longest_iteration(const SpanUnitParameters& parameters, std::uint64_t columns, std::uint64_t lines) {
  return 2 * columns + lines * (parameters.start_edge == StartEdge::lattice ? 2 : 1);
}

}  // namespace rastertlm::span_unit
