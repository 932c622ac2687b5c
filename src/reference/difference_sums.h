// Sums of differences of levels, at places with three channels each.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "src/frame/frame.h"

namespace rastertlm::reference {

struct DifferenceSums {
  std::uint64_t places = 0;
  std::uint64_t squares = 0;
  int largest = 0;  // |difference|

  void add(const std::array<int, 3>& differences) {
    ++places;
    for (const int difference : differences) {
      squares += static_cast<std::uint64_t>(difference * difference);
      largest = std::max(largest, std::abs(difference));
    }
  }
  DifferenceSums& operator+=(const DifferenceSums& other) {
    places += other.places;
    squares += other.squares;
    largest = std::max(largest, other.largest);
    return *this;
  }
  // Over all channels; none where there is no place.
  std::optional<double> rms() const {
    if (places == 0) return std::nullopt;
    return std::sqrt(static_cast<double>(squares) / (3.0 * static_cast<double>(places)));
  }
  std::optional<double> most() const { return places == 0 ? std::nullopt : std::optional<double>(largest); }
};

// By frame::Region.
using RegionDifferences = std::array<DifferenceSums, frame::kRegions>;

}  // namespace rastertlm::reference
