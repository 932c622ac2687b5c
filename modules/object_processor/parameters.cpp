#include "modules/object_processor/parameters.h"

#include <fmt/format.h>

namespace rastertlm::object_processor {

unsigned ObjectProcessorParameters::slices() const {
  return static_cast<unsigned>((word_bits + slice_bits - 1) / slice_bits);
}

double ObjectProcessorParameters::adder_delay_ns() const {
  const std::int64_t bits = slice_bits < word_bits ? slice_bits : word_bits;
  return adder_ns + adder_ns_per_bit * static_cast<double>(bits);
}

unsigned ObjectProcessorParameters::slices_that_fit(double period_ns) const {
  for (std::int64_t count = 1; count <= word_bits; ++count) {
    const std::int64_t bits = (word_bits + count - 1) / count;
    if (adder_ns + adder_ns_per_bit * static_cast<double>(bits) <= period_ns) return static_cast<unsigned>(count);
  }
  return 0;
}

void ObjectProcessorParameters::declare(parameter::Table& table) {
  table.text("object_processor.preset", preset,
             {"", "What the processors are built of: sets the object processor keys that the file does not.",
              "budgets[] adder_delay, line_start"});
  table.integer("object_processor.word_bits", word_bits, {8, 32},
                {"bits", "Width of coefficients, registers and depth of an elementary processor.",
                 "picture, memories[], decision_unit pins"});
  table.integer(
      "object_processor.slice_bits", slice_bits, {1, 32},
      {"bits", "Width of one slice of the pipelined adder, at most word_bits.", "budgets[] line_start, adder_delay"});
  table.integer(
      "object_processor.snap_bits", snap_bits, {-1, 12},
      {"bits", "Fraction bits to which the host snaps vertices; -1 takes the finest that fits the word.", "picture"});
  table.integer("object_processor.normal_bits", normal_bits, {4, 16},
                {"bits", "Width of a normal component after pre-normalisation: a sign above a magnitude.",
                 "picture, decision_unit pins"});
  table.choice(
      "object_processor.edges", edges, {"snapped", "scaled"},
      {"", "Edge words through snapped vertices with one scale a frame, or anchored with a scale an edge.", "picture"});
  table.choice("ep1.carry_clock", carry_clock, {"clock1", "clock2"},
               {"", "Clock of the carry flip-flop: clock1 is right, clock2 is the text of the paper and loses carries.",
                "picture"});
  table.integer("object_processor.prenormalisation_cycles", prenormalisation_cycles, {0, 64},
                {"cycles", "Register stages of the pre-normalisation unit.", "latency from microinstruction to pixel"});
  table.integer("object_processor.comparator_cycles", comparator_cycles, {1, 64},
                {"cycles", "Register stages of one depth comparator.", "latency of the decision unit, pipeline_skew"});
  table.real("object_processor.adder_ns", adder_ns, {0.0, 1000.0},
             {"ns", "Fixed part of an adder's delay.", "budgets[] adder_delay"});
  table.real("object_processor.adder_ns_per_bit", adder_ns_per_bit, {0.0, 1000.0},
             {"ns", "Delay of an adder a bit of its width.", "budgets[] adder_delay"});
}

void ObjectProcessorParameters::check(Diagnostics& diagnostics, const std::string& file) const {
  if (slice_bits > word_bits)
    diagnostics.add({file, 0, "object_processor.slice_bits",
                     fmt::format("is {}, wider than object_processor.word_bits = {}", slice_bits, word_bits)});
}

}  // namespace rastertlm::object_processor
