#include "modules/quadric_processor/parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/quadric_processor/quadric_words.h"
#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor {

object_processor::RootFormat QuadricParameters::root() const {
  return {static_cast<unsigned>(root_integer_bits), static_cast<unsigned>(root_guard_bits),
          static_cast<unsigned>(fraction_bits), root_reading};
}

unsigned QuadricParameters::slices_of(std::uint64_t bits) const {
  const auto slice = static_cast<std::uint64_t>(slice_bits);
  return static_cast<unsigned>((bits + slice - 1) / slice);
}
unsigned QuadricParameters::slices() const { return slices_of(static_cast<std::uint64_t>(word_bits)); }
unsigned QuadricParameters::plane_slices() const { return slices_of(static_cast<std::uint64_t>(plane_bits)); }

void QuadricParameters::declare(parameter::Table& table) {
  table.integer("quadric_processor.per_unit", per_unit, {0, 1 << 23},
                {"processors", "Quadric processors on the bus of each computation unit.",
                 "budgets[] quadrics, memories[], processors"});
  table.integer("quadric_processor.word_bits", word_bits, {16, kMostWordBits},
                {"bits", "Width of the second order processor: of the discriminant that the root is taken of.",
                 "picture of quadrics, memories[], budgets[] quadric_line_start"});
  table.integer("quadric_processor.fraction_bits", fraction_bits, {0, 32},
                {"bits", "Fraction bits of the discriminant, in square units of depth; at most word_bits - 2.",
                 "picture of quadrics"});
  table.integer("quadric_processor.plane_bits", plane_bits, {24, kMostPlaneBits},
                {"bits",
                 "Width of the first order processors of depth and caps, in units of the depth word; more than "
                 "object_processor.word_bits.",
                 "latency, memories[], budgets[] quadric_line_start, quadric_sum_delay; which solids are refused"});
  table.integer("quadric_processor.slice_bits", slice_bits, {1, 60},
                {"bits",
                 "Width of one slice of the pipelined adders of both, of the root's subtracters, the sums and the "
                 "multipliers: what is wider takes a clock a slice. At most 32 slices a word.",
                 "latency, memories[], budgets[] quadric_line_start, quadric_adder_delay, quadric_root_delay, "
                 "quadric_sum_delay, quadric_multiplier_delay"});
  table.integer("quadric_processor.caps", caps, {0, static_cast<std::int64_t>(kMostCaps)},
                {"planes", "Planes that may cut a solid, a first order processor each.",
                 "latency, memories[]; which solids are refused"});
  table.integer("quadric_processor.root_integer_bits", root_integer_bits, {1, kMostRootIntegerBits},
                {"bits", "Integer bits of the square root, in units of depth.",
                 "picture of quadrics, latency, memories[], budgets[] quadric_root_delay"});
  table.integer("quadric_processor.root_guard_bits", root_guard_bits, {0, 16},
                {"bits",
                 "Further bits of the square root, of fraction: one stage of its pipeline each. With "
                 "root_integer_bits at most 24.",
                 "picture of quadrics, latency, memories[], budgets[] quadric_root_delay"});
  table.choice("quadric_processor.root_reading", root_reading, {"floor", "half_unit"},
               {"", "How the root is read: as it is, up to a unit too small, or as the middle of its interval.",
                "picture of quadrics, latency, memories[]"});
  table.integer("quadric_processor.multiplier_bits", multiplier_bits, {12, 32},
                {"bits", "Width of the constants that the root is multiplied with for the normal.",
                 "picture of quadrics, latency, memories[], budgets[] quadric_multiplier_delay"});
  table.choice("quadric_processor.scaling", scaling, {"object", "fixed"},
               {"",
                "Whether the host scales each solid's discriminant until its root fills the extractor, or leaves it in "
                "units of depth.",
                "picture of quadrics, latency; which solids are refused"});
  table.choice("quadric_processor.on_refusal", on_refusal, {"error", "drop"},
               {"", "What a solid that the words cannot show does: it ends the run, or it is left out and counted.",
                "which scenes are refused"});
  table.choice("quadric_processor.alignment", alignment, {"early_start", "delay"},
               {"", "How fragments of triangles and quadrics meet: quadrics start earlier, or triangles wait.",
                "latency, memories[]"});
  table.integer("quadric_processor.output_cycles", output_cycles, {1, 64},
                {"cycles", "Register stages of the interval logic's choice, behind its comparators.", "latency"});
}

void QuadricParameters::check(const object_processor::ObjectProcessorParameters& triangles, Diagnostics& diagnostics,
                              const std::string& file) const {
  const auto refuse = [&](const char* key, std::string text) {
    diagnostics.add({file, 0, std::string("quadric_processor.") + key, std::move(text)});
  };
  if (per_unit == 0) return;
  if (triangles.carry_clock == object_processor::CarryClock::clock2)
    diagnostics.add({file, 0, "ep1.carry_clock", "quadric processors are modelled with \"clock1\" alone"});
  if (plane_bits <= triangles.word_bits)
    refuse("plane_bits", fmt::format("is {}; more than object_processor.word_bits, {}, is needed for depths before the "
                                     "near plane",
                                     plane_bits, triangles.word_bits));
  for (const std::int64_t width : {word_bits, plane_bits})
    if (slices_of(static_cast<std::uint64_t>(width)) > 32)
      refuse("slice_bits", fmt::format("{} bits in slices of {} are more than 32 slices", width, slice_bits));
  if (root_integer_bits + root_guard_bits > kMostRootBits)
    refuse("root_guard_bits",
           fmt::format("a root of {} bits is wider than {}", root_integer_bits + root_guard_bits, kMostRootBits));
  if (fraction_bits + 2 > word_bits)
    refuse("fraction_bits", fmt::format("is {}; a word of {} bits holds a sign, an integer bit and at most {}",
                                        fraction_bits, word_bits, word_bits - 2));
}

int depth_fraction_bits(int depth_bits, std::size_t columns, std::size_t lines) {
  return depth_bits - static_cast<int>(bit_length(static_cast<std::uint64_t>(std::max(columns, lines) - 1)));
}

}  // namespace rastertlm::quadric_processor
