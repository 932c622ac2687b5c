// What made a frame's pixels wrong, step by step, as reports have it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::report {

// Of a picture of numbers: what one stands for, and its colour.
struct LegendEntry {
  std::uint32_t value = 0;
  std::string name;
  std::string meaning;
  std::string colour;  // "#rrggbb"
};
using Legend = std::vector<LegendEntry>;

// Shares are of the sum of squares of the machine's differences from the ideal picture, over channels and compared
// pixels, levels not rounded.
struct StepFigures {
  std::string step;
  std::uint64_t blamed_pixels = 0;
  int blamed_max_level = 0;        // largest difference of the pixels that are blamed on it
  double removed_share = 0.0;      // that goes where it alone is made exact; negative: the others' error grows
  int left_max_level = 0;          // largest difference that is then left, rounded levels
  double left_rmse_level = 0.0;    // and its root mean square, not rounded
  double alone_share = 0.0;        // that it makes where all others are exact
  double interaction_share = 0.0;  // removed_share - alone_share
  double alone_max_level = 0.0;    // its largest difference then, not rounded
  double alone_p999_level = 0.0;   // of 999 pixels in 1000 not more, in steps of 1/64 level
  double alone_mean_level = 0.0;   // of the largest channel's
  double of_largest_level = 0.0;   // its share of the largest difference among pixels that show the right triangle
};

struct FrameBlameFigures {
  std::uint64_t frame = 0;
  std::uint64_t pixels = 0;        // that either picture covers
  std::uint64_t wrong = 0;         // of them, with a level that is not the ideal one, rounded
  std::uint64_t other_words = 0;   // of the wrong: words of another pose; they count in no share
  double rmse_level = 0.0;         // of what is explained, not rounded
  int max_level = 0;               // rounded
  double interaction_share = 0.0;  // 1 - the sum of what each makes alone
  std::vector<StepFigures> steps;  // in the order of the data
  double largest_level = 0.0;      // of pixels that show the right triangle, not rounded; steps' shares add up to it
  std::size_t largest_column = 0;  // where that is
  std::size_t largest_line = 0;
};

// The section "blame" of a report; none without frames.
struct BlameContents {
  Legend legend;
  std::vector<FrameBlameFigures> frames;
};

}  // namespace rastertlm::report
