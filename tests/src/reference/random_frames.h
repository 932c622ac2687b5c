// Random pictures of a machine beside exact ones, in runs of pixels that are alike, as pictures have them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "src/frame/frame.h"

namespace rastertlm::reference::testing_support {

struct FramePair {
  frame::Frame shown;
  frame::ExactFrame exact;
};

// Every mixture of covered, missing, extra and other triangles, regions and errors. Exact levels lie on halves, beside
// them and anywhere.
inline FramePair random_frames(std::size_t columns, std::size_t lines, std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(engine() % limit); };
  FramePair pair;
  pair.shown.resize(columns, lines);
  pair.exact.resize(columns, lines);
  const std::uint32_t longest = 1 + below(120);
  for (std::size_t pixel = 0; pixel < pair.exact.pixels();) {
    const std::size_t end = std::min<std::size_t>(pixel + 1 + below(longest), pair.exact.pixels());
    const std::uint32_t exact_object = below(4);
    const std::uint32_t shown_object = below(3) > 0 ? exact_object : below(4);
    const auto region = static_cast<frame::Region>(below(frame::kRegions));
    const std::uint32_t most = below(3) > 0 ? 2 : 1 + below(255);
    for (; pixel < end; ++pixel) {
      pair.exact.object[pixel] = exact_object;
      pair.shown.object[pixel] = shown_object;
      pair.exact.region[pixel] = region;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const std::uint32_t level = below(256);
        const double exact = below(2) == 0 ? level : std::min(level + 0.5, 255.0);
        const double beside[] = {exact, std::nextafter(exact, 0.0), std::min(std::nextafter(exact, 300.0), 255.0),
                                 std::min(level + below(1000) / 1000.0, 255.0)};
        pair.exact.rgb.set(i, beside[below(4)]);
        pair.shown.rgb[i] =
            static_cast<std::uint8_t>(std::min<std::uint32_t>(255, level + below(most) * (below(4) == 0 ? 1 : 0)));
      }
    }
  }
  return pair;
}

}  // namespace rastertlm::reference::testing_support
