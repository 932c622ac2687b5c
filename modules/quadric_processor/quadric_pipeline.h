// How long a quadric processor takes behind its elementary processors, from a pixel's words to its fragment. Nothing
// rests on an adder that is longer than a slice: a chain of full adders in one clock, along a carry or down carry-save
// rows, is at most `slice_bits` of them, and what needs more takes more clocks. How it is put together is ours; the
// papers name the operators.
//
// The root's stages follow each other, for each waits for the sign of the one before. Behind them, side by side:
// - depth: the shifter, then l - s and l + s, lowest slice first, and a clock behind each slice that of the comparisons
//   with entry and exit. What the caps and the planes of the view leave is found meanwhile in two trees of choices,
//   highest slice first, so that a level costs one clock;
// - the normal E -/+ k s: E and rows k s of carry-save adders, one a bit of the root; each row leaves its lowest bit
//   final, and a sliced adder joins sums and carries of the others.
// Then the interval logic chooses.
#pragma once

#include <cstdint>

#include "modules/object_processor/parameters.h"
#include "modules/quadric_processor/parameters.h"

namespace rastertlm::quadric_processor {

struct QuadricPipeline {
  // In full adders, as seen from one clock.
  struct Chains {
    std::uint64_t root = 0;    // of a stage's subtracter
    std::uint64_t sums = 0;    // of l -/+ s, and of the comparators
    std::uint64_t normal = 0;  // of the carry-save rows and of the adder behind them
  };

  std::uint64_t root_cycles = 0;
  std::uint64_t shifter_cycles = 0;     // 0 where solids have no scale
  std::uint64_t cap_cycles = 0;         // of the trees of caps; 0 without caps
  std::uint64_t sum_cycles = 0;         // a slice each
  std::uint64_t comparison_cycles = 1;  // by which the comparisons are behind the sums
  std::uint64_t row_cycles = 0;         // of the carry-save rows
  std::uint64_t join_cycles = 0;        // of the adder behind them
  std::uint64_t output_cycles = 0;
  Chains longest;

  std::uint64_t multiplier_cycles() const { return row_cycles + join_cycles; }
  std::uint64_t depth_cycles() const;  // from an EP2's word to the last comparison
  std::uint64_t latency_cycles() const;
};

// What is added up for a component of the normal: a word of the normal above the fraction of k s, modulo its width.
struct NormalRows {
  std::uint64_t bits = 0;                               // of a sum
  std::uint64_t fraction = 0;                           // of these, cut off at the end
  std::uint64_t rows = 0;                               // that add to these bits
  std::uint64_t joined() const { return bits - rows; }  // bits of which a sum and a carry are left
};
NormalRows normal_rows(const QuadricParameters& parameters,
                       const object_processor::ObjectProcessorParameters& triangles);

// Bits of the root as it is read.
std::uint64_t read_root_bits(const QuadricParameters& parameters);

// Bits of the subtracter of stage 1, 2, .. of the root: of a remainder of at most twice the root so far, with two new
// bits.
constexpr std::uint64_t subtracter_bits(std::uint64_t stage) { return stage + 2; }

QuadricPipeline quadric_pipeline(const QuadricParameters& parameters,
                                 const object_processor::ObjectProcessorParameters& triangles);

}  // namespace rastertlm::quadric_processor
