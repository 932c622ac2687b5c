#include "src/reference/error_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/base/mathematics.h"
#include "src/reference/edge_jumps.h"
#include "src/reference/level_sums.h"
#include "src/reference/picture_metrics.h"

namespace rastertlm::reference {
namespace {

using frame::kRegions;
using frame::Region;

// None where it is infinite.
std::optional<double> psnr(std::uint64_t squares, std::uint64_t pixels) {
  if (squares == 0) return std::nullopt;
  const double rmse = std::sqrt(static_cast<double>(squares) / (3.0 * static_cast<double>(pixels)));
  return 20.0 * mathematics::log(255.0 / rmse) / mathematics::log(10.0);
}

struct Sums {
  LevelSums levels;
  std::uint64_t wrong_order = 0;
  DifferenceSums edges;
  DifferenceSums flicker;
  Sums& operator+=(const Sums& other) {
    levels += other.levels;
    wrong_order += other.wrong_order;
    edges += other.edges;
    flicker += other.flicker;
    return *this;
  }
};

void take(const Sums& sums, RegionFigures& figures) {
  const LevelSums& levels = sums.levels;
  figures.compared = levels.compared;
  figures.covered_missing = levels.missing;
  figures.covered_extra = levels.extra;
  figures.wrong_object = levels.wrong_object;
  figures.wrong_order = sums.wrong_order;
  figures.max_level = levels.largest;
  figures.max_level_same_object = levels.largest_same_object;
  figures.edges_measured = sums.edges.places;
  figures.edge_jump_rms_level = sums.edges.rms();
  figures.edge_jump_max_level = sums.edges.most();
  figures.still_pixels = sums.flicker.places;
  figures.flicker_rms_level = sums.flicker.rms();
  figures.flicker_max_level = sums.flicker.most();
  figures.psnr_outline_db =
      psnr(levels.squares + levels.outline_squares, levels.compared + levels.missing + levels.extra);
  if (levels.compared == 0) return;
  const auto compared = static_cast<double>(levels.compared);
  figures.rmse_level = std::sqrt(static_cast<double>(levels.squares) / (3.0 * compared));
  figures.rmse_unrounded_level = std::sqrt(levels.unrounded_squares / (3.0 * compared));
  figures.over_one_level_percent = 100.0 * static_cast<double>(levels.over_one) / compared;
  figures.over_two_levels_percent = 100.0 * static_cast<double>(levels.over_two) / compared;
  figures.psnr_db = psnr(levels.squares, levels.compared);
}

// Whether the word is farther from everything that the exact picture shows around the pixel, planes continued by a
// pixel, than the bound allows.
bool is_wrong_order(const frame::Frame& shown, const frame::ExactFrame& exact, std::size_t pixel,
                    const DepthWords& words) {
  const std::size_t column = pixel % exact.columns;
  const std::size_t line = pixel / exact.columns;
  double nearest = exact.depth[pixel];
  double farthest = nearest;
  for (std::size_t y = line > 0 ? line - 1 : 0; y <= std::min(line + 1, exact.lines - 1); ++y)
    for (std::size_t x = column > 0 ? column - 1 : 0; x <= std::min(column + 1, exact.columns - 1); ++x) {
      const std::size_t around = y * exact.columns + x;
      if (exact.object[around] == 0) continue;
      nearest = std::min(nearest, exact.depth[around]);
      farthest = std::max(farthest, exact.depth[around]);
    }
  const double range = words.far_word - words.near_word;
  const double room = words.bound + (farthest - nearest) * range;
  const auto word = static_cast<double>(shown.depth[pixel]);
  return word < words.near_word + nearest * range - room || word > words.near_word + farthest * range + room;
}

void take_as_seen(const std::vector<double>& flip, const std::vector<double>& ciede2000, RegionFigures& figures) {
  if (flip.empty()) return;
  const SeenFigures seen = seen_figures(flip, ciede2000);
  figures.flip_mean = seen.flip_mean;
  figures.flip_p95 = seen.flip_p95;
  figures.ciede2000_mean = seen.ciede2000_mean;
  figures.ciede2000_p99 = seen.ciede2000_p99;
}

void add_as_seen(const frame::Frame& shown, const frame::ExactFrame& exact, double pixels_per_degree,
                 ErrorFigures& figures) {
  std::vector<double> wanted(exact.rgb.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = exact.rgb.rounded(i);
  const std::vector<double> levels(shown.rgb.begin(), shown.rgb.end());
  const PerceptualFigures seen = compare_as_seen(exact.columns, exact.lines, wanted, levels, pixels_per_degree);
  const auto part = [&](Region region, const std::vector<double>& values) {
    std::vector<double> there;
    for (std::size_t pixel = 0; pixel < values.size(); ++pixel)
      if (exact.region[pixel] == region) there.push_back(values[pixel]);
    return there;
  };
  take_as_seen(seen.flip, seen.ciede2000, figures);
  take_as_seen(part(Region::inside, seen.flip), part(Region::inside, seen.ciede2000), figures.inside);
  take_as_seen(part(Region::silhouettes, seen.flip), part(Region::silhouettes, seen.ciede2000), figures.silhouettes);
  take_as_seen(part(Region::highlights, seen.flip), part(Region::highlights, seen.ciede2000), figures.highlights);
}

}  // namespace

ErrorFigures ErrorMeter::measure(const frame::Frame& shown, const frame::ExactFrame& exact) {
  const LevelComparison comparison = compare_frames(shown, exact);
  const RegionDifferences edges = edge_jumps(shown, exact);
  const RegionDifferences flicker = flicker_.add(shown, exact);
  std::array<Sums, kRegions> sums;
  for (std::size_t region = 0; region < kRegions; ++region)
    sums[region] = {comparison.regions[region], 0, edges[region], flicker[region]};
  std::uint64_t others = 0;
  for (const Sums& one : sums) others += one.levels.wrong_object;
  if (options_.depth && others > 0)
    for (const std::size_t pixel : wrong_objects(shown, exact))
      if (is_wrong_order(shown, exact, pixel, *options_.depth))
        ++sums[static_cast<std::size_t>(exact.region[pixel])].wrong_order;

  ErrorFigures figures;
  figures.reference = options_.reference;
  Sums all;
  for (const Sums& one : sums) all += one;
  take(all, figures);
  const auto of = [&](Region region) -> const Sums& { return sums[static_cast<std::size_t>(region)]; };
  take(of(Region::inside), figures.inside);
  take(of(Region::silhouettes), figures.silhouettes);
  take(of(Region::highlights), figures.highlights);
  if (options_.perceptual_pixels_per_degree) add_as_seen(shown, exact, *options_.perceptual_pixels_per_degree, figures);
  return figures;
}

}  // namespace rastertlm::reference
