// What a quadric processor is made of, for the memory and logic budget; and the time that its microprograms take.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/quadric_processor/parameters.h"
#include "src/base/units.h"

namespace rastertlm::quadric_processor {

// Words of one kind in the loading RAM of a processor, and again in its backup RAM.
struct QuadricRam {
  std::string name;
  std::uint64_t words = 0;
  std::uint64_t bits_per_word = 0;
  std::uint64_t replaced = 0;  // of the words: by what lines make of them, so that they are kept once more
};

struct QuadricLogic {
  std::vector<QuadricRam> rams;
  std::uint64_t register_bits = 0;  // accumulators, synchronisation, what the pipeline behind them holds; no flags
  std::uint64_t adders = 0;         // slices of all adders and subtracters
  std::uint64_t adder_bits = 0;
  std::uint64_t multipliers = 0;      // of the root with constants
  std::uint64_t multiplier_bits = 0;  // full adders of their carry-save rows
  std::uint64_t comparators = 0;      // of entry and exit, plane_bits each, and one of the depth word
  std::uint64_t root_stages = 0;
  std::uint64_t shifters = 0;  // between root and depth, where solids have scales; and of the pre-normalisation unit
};

// `material_bits`: of a link word.
QuadricLogic quadric_logic(const QuadricParameters& parameters,
                           const object_processor::ObjectProcessorParameters& triangles, unsigned material_bits);

// The longest of the line starts of a processor, its EP2's or that of the wide EP1s, which is longer where these have
// many more slices. `lines` lie between the line that was shown before and this one; of the first line after a retrace,
// between none and it (1 and more): an EP2 shows the first line that it was loaded for, an EP1 steps to it.
Cycles line_start_cycles(const QuadricParameters& parameters, std::uint64_t lines, bool after_retrace = false);
// Of it the steps over lines, before what begins the line.
Cycles line_step_cycles(const QuadricParameters& parameters, std::uint64_t lines, bool after_retrace = false);

}  // namespace rastertlm::quadric_processor
