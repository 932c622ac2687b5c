// Is flicker what a plain loop over two frames finds?
#include "src/reference/flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/src/reference/random_frames.h"

namespace rastertlm::reference {
namespace {

using testing_support::FramePair;
using testing_support::random_frames;

std::vector<std::uint8_t> rounded(const FramePair& pair) {
  std::vector<std::uint8_t> levels;
  for (const double level : pair.exact.rgb) levels.push_back(static_cast<std::uint8_t>(std::floor(level + 0.5)));
  return levels;
}

// The next frame: some exact levels move a little or much, displayed ones anyhow.
FramePair moved(const FramePair& pair, std::uint32_t seed) {
  FramePair next = random_frames(pair.exact.columns, pair.exact.lines, seed + 1000);
  std::mt19937 engine(seed);
  for (std::size_t i = 0; i < next.exact.rgb.size(); ++i)
    if (engine() % 8 != 0) {
      const double by = static_cast<double>(engine() % 3) - 1.0;
      next.exact.rgb.set(i, std::clamp(std::floor(pair.exact.rgb[i] + 0.5) + by, 0.0, 255.0));
    }
  return next;
}

RegionDifferences plain(const FramePair& before, const FramePair& now) {
  const std::vector<std::uint8_t> exact_before = rounded(before), exact = rounded(now);
  RegionDifferences sums{};
  for (std::size_t pixel = 0; pixel < now.exact.pixels(); ++pixel) {
    const auto compared = [&](const FramePair& pair) {
      return pair.shown.object[pixel] != 0 && pair.exact.object[pixel] != 0;
    };
    if (!compared(before) || !compared(now)) continue;
    std::array<int, 3> change{};
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * pixel + c;
      most = std::max(most, std::abs(exact[i] - exact_before[i]));
      change[c] = (now.shown.rgb[i] - exact[i]) - (before.shown.rgb[i] - exact_before[i]);
    }
    if (most <= kStillLevels) sums[static_cast<std::size_t>(now.exact.region[pixel])].add(change);
  }
  return sums;
}

TEST(Flicker, IsWhatAPlainLoopFinds) {
  std::uint64_t still = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const FramePair first = random_frames(1 + seed * 11 % 80, 1 + seed % 9, seed);
    const FramePair second = moved(first, seed);
    FlickerMeter meter;
    for (const DifferenceSums& sums : meter.add(first.shown, first.exact)) EXPECT_EQ(sums.places, 0U);
    const RegionDifferences found = meter.add(second.shown, second.exact);
    const RegionDifferences wanted = plain(first, second);
    for (std::size_t region = 0; region < found.size(); ++region) {
      EXPECT_EQ(found[region].places, wanted[region].places) << seed;
      EXPECT_EQ(found[region].squares, wanted[region].squares) << seed;
      EXPECT_EQ(found[region].largest, wanted[region].largest) << seed;
      still += found[region].places;
    }
  }
  EXPECT_GT(still, 500U);
}

}  // namespace
}  // namespace rastertlm::reference
