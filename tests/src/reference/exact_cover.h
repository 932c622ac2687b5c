// Coverage in exact integers, put in another way than the renderers': for the tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "src/reference/coverage.h"

namespace rastertlm::reference::testing_support {

__extension__ using Wide = __int128;

// The top-left rule put another way: a sample is inside where the point (x + e, y + e^2), e infinitely small, is
// strictly inside. Here e is 2^-23 of a unit and e^2 becomes 2^-44: with coordinates below 2^20 no edge passes between.
// Orientation does not matter.
inline bool covers_exactly(const std::array<Point<std::int64_t>, 3>& t, std::int64_t x, std::int64_t y) {
  const Wide unit = Wide{1} << 44;
  const Wide px = x * unit + (Wide{1} << 21);
  const Wide py = y * unit + 1;
  int positive = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point<std::int64_t>& a = t[i];
    const Point<std::int64_t>& b = t[(i + 1) % 3];
    const Wide e = Wide{b.x - a.x} * (py - a.y * unit) - Wide{b.y - a.y} * (px - a.x * unit);
    positive += e > 0 ? 1 : 0;
  }
  return positive == 0 || positive == 3;
}

inline std::int64_t doubled_area(const std::array<Point<std::int64_t>, 3>& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
}

// What a naive renderer found at a pixel. `nearest` is nothing where another surface is too near to tell them apart.
struct Found {
  std::uint32_t coverage = 0;
  std::optional<std::uint32_t> nearest;
  double depth = 2.0;

  void add(std::uint32_t object, double z) {
    ++coverage;
    if (std::abs(z - depth) < 1e-9) {
      nearest.reset();
    } else if (z < depth) {
      nearest = object;
    }
    depth = std::min(depth, z);
  }
};

}  // namespace rastertlm::reference::testing_support
