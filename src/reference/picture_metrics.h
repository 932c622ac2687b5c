// How far apart two pictures are, whatever they show: by levels, and as the eye sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/reference/flip.h"

namespace rastertlm::reference {

// Of the differences of each channel of each pixel. A level is 1/255 of a channel.
struct LevelFigures {
  double max_level = 0.0;                // largest |difference|
  double over_one_level_percent = 0.0;   // pixels with a channel that differs by more than one level
  double over_two_levels_percent = 0.0;  // by more than two
  double rmse_level = 0.0;               // root of the mean square difference of all channels
  std::optional<double> psnr_db;         // 20 log10(255 / rmse_level); none where it is infinite
};

// Levels, 3 a pixel: 0..255, or real ones, which are not rounded. std::invalid_argument where sizes differ, or nothing
// is there.
LevelFigures compare_levels(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second);
LevelFigures compare_levels(std::span<const double> first, std::span<const double> second);

// A percentile p is the least value that p percent of the pixels do not exceed.
struct SeenFigures {
  double flip_mean = 0.0;  // 0 no difference is seen .. 1
  double flip_p95 = 0.0;
  double ciede2000_mean = 0.0;  // 1: just seen
  double ciede2000_p99 = 0.0;
};
struct PerceptualFigures : SeenFigures {
  double pixels_per_degree = kDefaultPixelsPerDegree;
  std::vector<double> flip;       // of each pixel
  std::vector<double> ciede2000;  // likewise
};

// Of so many pixels' values; there is at least one.
SeenFigures seen_figures(const std::vector<double>& flip, const std::vector<double>& ciede2000);

// The same pixels as sRGB, levels outside 0..255 as the nearest within. The first picture is FLIP's reference, though
// FLIP is symmetric. Asked for apart, for its cost. std::invalid_argument as flip_map.
PerceptualFigures compare_as_seen(std::size_t columns, std::size_t lines, std::span<const double> first,
                                  std::span<const double> second, double pixels_per_degree = kDefaultPixelsPerDegree);

// The least of the values that `percent` (0 < percent <= 100) of them do not exceed; there is at least one.
double percentile(std::vector<double> values, double percent);

// The mean of the values; there is at least one.
double mean(const std::vector<double>& values);

}  // namespace rastertlm::reference
