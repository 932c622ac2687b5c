#include "src/reference/edge_jumps.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace rastertlm::reference {
namespace {

constexpr std::size_t kPixels = 4;  // across an edge

void add_jump(const frame::Frame& shown, const frame::ExactFrame& exact, std::size_t pixel, std::size_t step,
              RegionDifferences& sums) {
  const std::array<std::size_t, kPixels> across{pixel - step, pixel, pixel + step, pixel + 2 * step};
  const auto is_right = [&](std::size_t one) { return shown.object[one] == exact.object[one]; };
  if (!std::all_of(across.begin(), across.end(), is_right)) return;
  std::array<int, 3> jump{};
  for (std::size_t c = 0; c < jump.size(); ++c) {
    const auto error = [&](std::size_t one) {
      return shown.rgb[3 * across[one] + c] - exact.rgb.rounded(3 * across[one] + c);
    };
    jump[c] = (error(3) - error(2)) - (error(1) - error(0));
  }
  sums[static_cast<std::size_t>(exact.region[pixel])].add(jump);
}

}  // namespace

RegionDifferences edge_jumps(const frame::Frame& shown, const frame::ExactFrame& exact) {
  RegionDifferences sums{};
  const auto look = [&](std::size_t pixel) {
    const std::uint8_t edges = exact.edges[pixel];
    if ((edges & frame::kEdgeToTheRight) != 0) add_jump(shown, exact, pixel, 1, sums);
    if ((edges & frame::kEdgeBelow) != 0) add_jump(shown, exact, pixel, exact.columns, sums);
  };
  // Most pixels have none: eight are passed over at a time.
  std::uint64_t eight = 0;
  const std::size_t pixels = exact.pixels();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (pixel % sizeof(eight) == 0 && pixel + sizeof(eight) <= pixels) {
      std::memcpy(&eight, exact.edges.data() + pixel, sizeof(eight));
      if (eight == 0) pixel += sizeof(eight) - 1;
      if (eight == 0) continue;
    }
    if (exact.edges[pixel] != 0) look(pixel);
  }
  return sums;
}

}  // namespace rastertlm::reference
