#include "src/reference/picture_metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/base/mathematics.h"
#include "src/reference/colour.h"

namespace rastertlm::reference {
namespace {

// Sums of a block of pixels. Of bytes they are integers of 32 bits, so that a processor adds many at once; a block
// cannot overflow them: 3 * 4096 * 255^2 < 2^32.
constexpr std::size_t kBlockPixels = 4096;

template <class Level>
struct Sums;
template <>
struct Sums<std::uint8_t> {
  using Value = std::int32_t;
  using Square = std::uint32_t;
};
template <>
struct Sums<double> {
  using Value = double;
  using Square = double;
};

template <class Level>
LevelFigures compare(std::span<const Level> first, std::span<const Level> second) {
  using Value = typename Sums<Level>::Value;
  using Square = typename Sums<Level>::Square;
  if (first.size() != second.size() || first.empty() || first.size() % 3 != 0)
    throw std::invalid_argument("compare_levels: pictures of different sizes, or of none");
  const std::size_t pixels = first.size() / 3;
  Value largest = 0;
  double squares = 0.0;  // of integers: exact
  std::uint64_t over_one = 0;
  std::uint64_t over_two = 0;
  for (std::size_t begin = 0; begin < pixels; begin += kBlockPixels) {
    const std::size_t end = std::min(begin + kBlockPixels, pixels);
    Square sum = 0;
    std::uint32_t ones = 0;
    std::uint32_t twos = 0;
    for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
      const Value r = std::abs(static_cast<Value>(first[i]) - static_cast<Value>(second[i]));
      const Value g = std::abs(static_cast<Value>(first[i + 1]) - static_cast<Value>(second[i + 1]));
      const Value b = std::abs(static_cast<Value>(first[i + 2]) - static_cast<Value>(second[i + 2]));
      const Value most = std::max(r, std::max(g, b));
      sum += static_cast<Square>(r * r + g * g + b * b);
      ones += most > 1 ? 1U : 0U;
      twos += most > 2 ? 1U : 0U;
      largest = std::max(largest, most);
    }
    squares += static_cast<double>(sum);
    over_one += ones;
    over_two += twos;
  }
  LevelFigures figures;
  figures.max_level = static_cast<double>(largest);
  figures.over_one_level_percent = 100.0 * static_cast<double>(over_one) / static_cast<double>(pixels);
  figures.over_two_levels_percent = 100.0 * static_cast<double>(over_two) / static_cast<double>(pixels);
  figures.rmse_level = std::sqrt(squares / static_cast<double>(first.size()));
  if (figures.rmse_level > 0.0)
    figures.psnr_db = 20.0 * mathematics::log(255.0 / figures.rmse_level) / mathematics::log(10.0);
  return figures;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
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
  figures.flip_mean = mean(figures.flip);
  figures.flip_p95 = percentile(figures.flip, 95.0);
  figures.ciede2000 = ciede2000_map(shown_first, shown_second);
  figures.ciede2000_mean = mean(figures.ciede2000);
  figures.ciede2000_p99 = percentile(figures.ciede2000, 99.0);
  return figures;
}

double percentile(std::vector<double> values, double percent) {
  if (values.empty() || !(percent > 0.0 && percent <= 100.0)) throw std::invalid_argument("percentile: of nothing");
  const double rank = std::ceil(percent * static_cast<double>(values.size()) / 100.0);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace rastertlm::reference
