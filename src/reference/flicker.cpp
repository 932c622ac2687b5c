#include "src/reference/flicker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/reference/level_kernels.h"

namespace rastertlm::reference {
namespace {

constexpr std::uint32_t kCounted = kComparedNow | kComparedBefore | kStill;

void take(const std::array<KindSums, kPixelKinds>& sums, RegionDifferences& regions) {
  for (std::size_t region = 0; region < regions.size(); ++region) {
    const KindSums& from = sums[region | kCounted];
    DifferenceSums& into = regions[region];
    into.places += from.pixels;
    for (std::size_t i = 0; i < kLevelGroup; ++i) {
      into.squares += from.squares[i];
      into.largest = std::max(into.largest, static_cast<int>(std::sqrt(from.largest_square[i])));  // exact of squares
    }
  }
}

}  // namespace

RegionDifferences FlickerMeter::add(const frame::Frame& shown, const frame::ExactFrame& exact) {
  const std::size_t pixels = exact.pixels();
  const std::size_t groups = (pixels + kLevelGroup - 1) / kLevelGroup;
  const std::size_t padded = groups * kLevelGroup;
  now_.shown.resize(3 * padded);
  for (std::vector<std::uint8_t>* plane : {&now_.compared, &kind_}) plane->resize(padded);
  std::copy(shown.rgb.begin(), shown.rgb.end(), now_.shown.begin());
  now_.exact = exact.rgb.rounded_planes();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    now_.compared[pixel] =
        static_cast<std::uint8_t>(shown.object[pixel] != 0 && exact.object[pixel] != 0 ? kComparedBefore : 0);
  RegionDifferences regions{};
  if (before_.compared.size() == padded) {
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
      kind_[pixel] =
          static_cast<std::uint8_t>(static_cast<std::uint32_t>(exact.region[pixel]) | before_.compared[pixel] |
                                    (now_.compared[pixel] != 0 ? kComparedNow : 0));
    for (std::size_t group = 0; group < groups; group += kMostGroups) {
      const std::size_t at = group * kLevelGroup;
      std::array<KindSums, kPixelKinds> sums{};
      level_kernels(vector_variant())
          .add_changes(
              {std::min(kMostGroups, groups - group), kind_.data() + at, now_.shown.data() + 3 * at,
               now_.exact.data() + 3 * at, before_.shown.data() + 3 * at, before_.exact.data() + 3 * at, kStillLevels},
              sums.data());
      take(sums, regions);
    }
  }
  std::swap(before_, now_);
  return regions;
}

}  // namespace rastertlm::reference
