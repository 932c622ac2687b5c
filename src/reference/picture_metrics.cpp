#include "src/reference/picture_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "src/base/mathematics.h"
#include "src/reference/colour.h"

namespace rastertlm::reference {
namespace {

// What is summed of pixels.
struct Sums {
  double largest = 0.0;
  double squares = 0.0;  // of bytes: integers, exact
  std::uint64_t over_one = 0;
  std::uint64_t over_two = 0;
};

// Bytes go block by block through plain loops that any compiler turns into vectors. No sum overflows:
// 3 * 4096 * 255^2 < 2^32.
constexpr std::size_t kBlockPixels = 4096;
constexpr std::size_t kBlockBytes = 3 * kBlockPixels;

// 1 at the first channel of each pixel.
struct FirstChannels {
  std::array<std::uint8_t, kBlockBytes> mask{};
  constexpr FirstChannels() {
    for (std::size_t i = 0; i < kBlockBytes; i += 3) mask[i] = 1;
  }
};
constexpr FirstChannels kFirst;

// By value: std::max hands references on, which keeps loops from becoming vectors.
std::uint8_t larger(std::uint8_t a, std::uint8_t b) { return a > b ? a : b; }
std::uint8_t smaller(std::uint8_t a, std::uint8_t b) { return a < b ? a : b; }

void add_block(const std::uint8_t* first, const std::uint8_t* second, std::size_t bytes, Sums& sums) {
  std::uint8_t difference[kBlockBytes + 2];
  for (std::size_t i = 0; i < bytes; ++i)
    difference[i] = static_cast<std::uint8_t>(larger(first[i], second[i]) - smaller(first[i], second[i]));
  difference[bytes] = difference[bytes + 1] = 0;
  std::uint8_t largest = 0;
  for (std::size_t i = 0; i < bytes; ++i) largest = larger(largest, difference[i]);
  std::uint32_t squares = 0;
  for (std::size_t i = 0; i < bytes; ++i) squares += static_cast<std::uint32_t>(difference[i] * difference[i]);
  std::uint32_t over_one = 0;
  std::uint32_t over_two = 0;
  if (largest > 1) {
    for (std::size_t i = 0; i < bytes; ++i)
      difference[i] = larger(difference[i], larger(difference[i + 1], difference[i + 2]));
    for (std::size_t i = 0; i < bytes; ++i) over_one += kFirst.mask[i] & (difference[i] > 1 ? 1U : 0U);
    for (std::size_t i = 0; i < bytes; ++i) over_two += kFirst.mask[i] & (difference[i] > 2 ? 1U : 0U);
  }
  sums.largest = std::max(sums.largest, static_cast<double>(largest));
  sums.squares += squares;
  sums.over_one += over_one;
  sums.over_two += over_two;
}

Sums sums_of(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second) {
  Sums sums;
  for (std::size_t begin = 0; begin < first.size(); begin += kBlockBytes)
    add_block(first.data() + begin, second.data() + begin, std::min(kBlockBytes, first.size() - begin), sums);
  return sums;
}

Sums sums_of(std::span<const double> first, std::span<const double> second) {
  Sums sums;
  for (std::size_t i = 0; i < first.size(); i += 3) {
    double most = 0.0;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double d = std::abs(first[c] - second[c]);
      sums.squares += d * d;
      most = std::max(most, d);
    }
    sums.over_one += most > 1.0 ? 1 : 0;
    sums.over_two += most > 2.0 ? 1 : 0;
    sums.largest = std::max(sums.largest, most);
  }
  return sums;
}

template <class Level>
LevelFigures compare(std::span<const Level> first, std::span<const Level> second) {
  if (first.size() != second.size() || first.empty() || first.size() % 3 != 0)
    throw std::invalid_argument("compare_levels: pictures of different sizes, or of none");
  const Sums sums = sums_of(first, second);
  const double pixels = static_cast<double>(first.size()) / 3.0;
  LevelFigures figures;
  figures.max_level = sums.largest;
  figures.over_one_level_percent = 100.0 * static_cast<double>(sums.over_one) / pixels;
  figures.over_two_levels_percent = 100.0 * static_cast<double>(sums.over_two) / pixels;
  figures.rmse_level = std::sqrt(sums.squares / static_cast<double>(first.size()));
  if (figures.rmse_level > 0.0)
    figures.psnr_db = 20.0 * mathematics::log(255.0 / figures.rmse_level) / mathematics::log(10.0);
  return figures;
}

std::vector<double> shown_levels(std::span<const double> levels) {
  std::vector<double> shown(levels.size());
  std::transform(levels.begin(), levels.end(), shown.begin(), [](double v) { return std::clamp(v, 0.0, 255.0); });
  return shown;
}

std::vector<double> ciede2000_map(const std::vector<double>& first, const std::vector<double>& second) {
  const auto lab = [](const std::vector<double>& levels, std::size_t i) {
    return lab_of_xyz(
        xyz_of_linear({linear_light(levels[i]), linear_light(levels[i + 1]), linear_light(levels[i + 2])}));
  };
  std::vector<double> differences(first.size() / 3);
  for (std::size_t pixel = 0; pixel < differences.size(); ++pixel)
    differences[pixel] = ciede2000(lab(first, 3 * pixel), lab(second, 3 * pixel));
  return differences;
}

}  // namespace

LevelFigures compare_levels(std::span<const std::uint8_t> first, std::span<const std::uint8_t> second) {
  return compare(first, second);
}

LevelFigures compare_levels(std::span<const double> first, std::span<const double> second) {
  return compare(first, second);
}

PerceptualFigures compare_as_seen(std::size_t columns, std::size_t lines, std::span<const double> first,
                                  std::span<const double> second, double pixels_per_degree) {
  const std::vector<double> shown_first = shown_levels(first);
  const std::vector<double> shown_second = shown_levels(second);
  PerceptualFigures figures;
  figures.pixels_per_degree = pixels_per_degree;
  figures.flip = flip_map(columns, lines, shown_first, shown_second, pixels_per_degree);
  figures.ciede2000 = ciede2000_map(shown_first, shown_second);
  static_cast<SeenFigures&>(figures) = seen_figures(figures.flip, figures.ciede2000);
  return figures;
}

SeenFigures seen_figures(const std::vector<double>& flip, const std::vector<double>& ciede2000) {
  return {mean(flip), percentile(flip, 95.0), mean(ciede2000), percentile(ciede2000, 99.0)};
}

double mean(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("mean: of nothing");
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double percentile(std::vector<double> values, double percent) {
  if (values.empty() || !(percent > 0.0 && percent <= 100.0)) throw std::invalid_argument("percentile: of nothing");
  const double rank = std::ceil(percent * static_cast<double>(values.size()) / 100.0);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace rastertlm::reference
