// The levels of a machine's picture against an exact one, summed for each part of the picture. By vector kernels
// (level_kernels.h) from what the exact picture keeps for that: rounded levels and residuals
// (src/frame/exact_levels.h). Pixels that neither picture covers are passed over sixteen at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/frame/frame.h"

namespace rastertlm::reference {

// Of the pixels of one region; "compared" as in error_figures.h.
struct LevelSums {
  std::uint64_t compared = 0;
  std::uint64_t missing = 0;
  std::uint64_t extra = 0;
  std::uint64_t wrong_object = 0;
  std::uint64_t squares = 0;          // of integer differences of compared pixels' channels
  std::uint64_t outline_squares = 0;  // the same of pixels that one picture alone covers
  // Of compared pixels, against the exact level that is not rounded; within 7 / 2^24 of itself. A difference is an
  // integer less a residual, no larger than it, within 2^-24 of both; float rounds it, its square and two additions.
  double unrounded_squares = 0.0;
  std::uint64_t over_one = 0;  // compared pixels with a channel that differs by more than one level
  std::uint64_t over_two = 0;
  int largest = 0;
  int largest_same_object = 0;

  LevelSums& operator+=(const LevelSums& other);
};

struct LevelComparison {
  std::array<LevelSums, frame::kRegions> regions;  // by frame::Region
};

// Both pictures of the same size, else std::invalid_argument.
LevelComparison compare_frames(const frame::Frame& shown, const frame::ExactFrame& exact);

// The pixels that both pictures cover by different objects, in order.
std::vector<std::size_t> wrong_objects(const frame::Frame& shown, const frame::ExactFrame& exact);

}  // namespace rastertlm::reference
