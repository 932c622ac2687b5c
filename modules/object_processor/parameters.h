// What an architect may choose of the object processors (004, section 5.2).
#pragma once

#include <cstdint>
#include <string>

#include "src/base/errors.h"
#include "src/parameter/table.h"

namespace rastertlm::object_processor {

// How the host fits edge words: all of a frame with one power of two through snapped vertices, or a scale of its own
// for every edge.
enum class EdgeForm { snapped, scaled };

// The clock of the flip-flop that carries from one slice of the adder to the next. clock1, that of the slice which
// makes the carry, is right; clock2, that of the slice which takes it, is the text of 004 and loses carries (its
// picture is wrong).
enum class CarryClock { clock1, clock2 };

struct ObjectProcessorParameters {
  std::string preset = "standard_cell_1991";
  std::int64_t word_bits = 24;   // of a coefficient, a register and the depth on the link
  std::int64_t slice_bits = 12;  // of one adder; at most word_bits
  std::int64_t snap_bits = -1;   // fraction bits of snapped vertices; -1: the finest that fits the word
  std::int64_t normal_bits = 12;
  EdgeForm edges = EdgeForm::snapped;
  CarryClock carry_clock = CarryClock::clock1;
  std::int64_t prenormalisation_cycles = 1;
  std::int64_t comparator_cycles = 1;
  double adder_ns = 0.0;  // standard cell of 1991
  double adder_ns_per_bit = 4.0;

  unsigned slices() const;        // ceil(word_bits / slice_bits)
  double adder_delay_ns() const;  // of one slice: what must fit in a clock period
  // The fewest slices whose delay fits in `period_ns`; 0 where a single bit does not.
  unsigned slices_that_fit(double period_ns) const;

  void declare(parameter::Table& table);
  // What one range cannot say: `file` names the machine file in the diagnostics.
  void check(Diagnostics& diagnostics, const std::string& file) const;
};

}  // namespace rastertlm::object_processor
