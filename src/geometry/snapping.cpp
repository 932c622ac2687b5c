#include "src/geometry/snapping.h"

#include <algorithm>

namespace rastertlm::geometry {
namespace {

// Finer grids bring nothing: clip-space coordinates in double are the limit of the host, and words of the model stay
// small.
constexpr int kFinestFractionBits = 12;

// Largest q with box_w * box_h * 2^q <= 2^(word_bits-1) - 2 (one unit is left for the rounding of C), or -1.
int fitting_bits(std::int64_t box_w, std::int64_t box_h, int word_bits) {
  const std::int64_t limit = (std::int64_t{1} << (word_bits - 1)) - 2;
  int q = -1;
  while (q < kFinestFractionBits && ((box_w * box_h) << (q + 1)) <= limit) ++q;
  return q;
}

}  // namespace

std::optional<SnapGrids> snap_grids(std::size_t columns, std::size_t lines, int word_bits, int limit) {
  const auto box_w = static_cast<std::int64_t>(columns) - 1;
  const auto box_h = static_cast<std::int64_t>(lines) - 1;
  const int on_screen = fitting_bits(box_w, box_h, word_bits);
  if (on_screen < 0) return std::nullopt;
  const auto capped = [limit](int q) { return limit >= 0 ? std::min(q, limit) : q; };

  // Just under half a screen on each side, a pixel less; where half-pixel vertices do not fit that, as much as does.
  std::int64_t guard_x = std::max<std::int64_t>(static_cast<std::int64_t>(columns) / 2 - 1, 0);
  std::int64_t guard_y = std::max<std::int64_t>(static_cast<std::int64_t>(lines) / 2 - 1, 0);
  const int wanted = std::min(1, on_screen);
  while (fitting_bits(box_w + 2 * guard_x, box_h + 2 * guard_y, word_bits) < wanted) {
    guard_x -= (guard_x + 15) / 16;
    guard_y -= (guard_y + 15) / 16;
  }
  const int guarded = fitting_bits(box_w + 2 * guard_x, box_h + 2 * guard_y, word_bits);
  return SnapGrids{{capped(on_screen), 0, 0}, {capped(guarded), guard_x, guard_y}};
}

int word_bits_needed(std::size_t columns, std::size_t lines) {
  int bits = 2;
  while (!snap_grids(columns, lines, bits, -1)) ++bits;
  return bits;
}

ClipVolume clip_volume(const SnapGrid& grid, const Viewport& viewport) {
  const auto ndc = [](double pixel, std::size_t count) {
    return (pixel + 0.5) * 2.0 / static_cast<double>(count) - 1.0;
  };
  const auto columns = static_cast<double>(viewport.columns);
  const auto lines = static_cast<double>(viewport.lines);
  const auto guard_x = static_cast<double>(grid.guard_x);
  const auto guard_y = static_cast<double>(grid.guard_y);
  return {ndc(-guard_x, viewport.columns), ndc(columns - 1 + guard_x, viewport.columns),
          -ndc(lines - 1 + guard_y, viewport.lines), -ndc(-guard_y, viewport.lines)};
}

}  // namespace rastertlm::geometry
