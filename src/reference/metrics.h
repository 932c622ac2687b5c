// How far a machine's picture is from an exact one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "src/frame/frame.h"

namespace rastertlm::reference {

// A pixel is covered where `object` is not 0. Levels are compared where both pictures are covered ("compared" pixels),
// a channel at a time: the displayed level minus floor(exact + 1/2), an integer. Pixels that one picture alone covers
// are counted, not compared.
struct ErrorFigures {
  std::string reference;              // "ideal", "snapped", "true"
  std::uint64_t compared = 0;         // pixels covered in both
  std::uint64_t covered_missing = 0;  // pixels covered in the exact picture only
  std::uint64_t covered_extra = 0;    // pixels covered in the machine's only
  std::uint64_t wrong_object = 0;     // compared pixels that show different triangles
  int max_level = 0;                  // largest |difference| of all compared pixels
  int max_level_same_object = 0;      // of those that show the same triangle
  double rmse_level = 0.0;            // root of the mean square difference, over the channels of all compared pixels
  double rmse_unrounded_level =
      0.0;  // the same with the exact level not rounded: holds the display's own rounding, 0.29 levels at best
  std::optional<double> psnr_db;          // 20 log10(255 / rmse_level); none where rmse_level is 0 (infinite)
  std::optional<double> psnr_outline_db;  // the same over the pixels that either picture covers: a missing pixel counts
                                          // by what is seen instead
  double over_one_level_percent = 0.0;    // compared pixels with a channel that differs by more than one level
};

// Both of the same size, else std::invalid_argument.
ErrorFigures compare(const frame::Frame& shown, const frame::ExactFrame& exact, const std::string& reference);

// Largest |depth word - (near_word + z * (far_word - near_word))| in units of the depth word, over the pixels that show
// the same triangle in both pictures; 0 where there is none.
double largest_depth_error(const frame::Frame& shown, const frame::ExactFrame& exact, double near_word,
                           double far_word);

}  // namespace rastertlm::reference
