#include "src/reference/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "src/base/mathematics.h"

namespace rastertlm::reference {
namespace {

void require_same_size(const frame::Frame& shown, const frame::ExactFrame& exact) {
  if (shown.columns != exact.columns || shown.lines != exact.lines)
    throw std::invalid_argument("pictures of different sizes are compared");
}

struct Sums {
  std::uint64_t squares = 0;
  double unrounded_squares = 0.0;
  std::uint64_t over_one = 0;
};

// The largest |difference| of the pixel's channels.
int add_pixel(const frame::Frame& shown, const frame::ExactFrame& exact, std::size_t pixel, Sums& sums) {
  int largest = 0;
  for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
    const int level = shown.rgb[i];
    const int difference = std::abs(level - static_cast<int>(std::floor(exact.rgb[i] + 0.5)));
    const double unrounded = level - exact.rgb[i];
    largest = std::max(largest, difference);
    sums.squares += static_cast<std::uint64_t>(difference) * static_cast<std::uint64_t>(difference);
    sums.unrounded_squares += unrounded * unrounded;
  }
  if (largest > 1) ++sums.over_one;
  return largest;
}

// None where it is infinite.
std::optional<double> psnr(std::uint64_t squares, std::uint64_t pixels) {
  if (squares == 0) return std::nullopt;
  const double rmse = std::sqrt(static_cast<double>(squares) / (3.0 * static_cast<double>(pixels)));
  return 20.0 * mathematics::log(255.0 / rmse) / mathematics::log(10.0);
}

}  // namespace

ErrorFigures compare(const frame::Frame& shown, const frame::ExactFrame& exact, const std::string& reference) {
  require_same_size(shown, exact);
  ErrorFigures figures;
  figures.reference = reference;
  Sums sums;
  Sums outline;  // of pixels that one picture alone covers
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    const bool in_shown = shown.object[pixel] != 0;
    const bool in_exact = exact.object[pixel] != 0;
    figures.covered_missing += !in_shown && in_exact ? 1 : 0;
    figures.covered_extra += in_shown && !in_exact ? 1 : 0;
    if (!in_shown && !in_exact) continue;
    if (!in_shown || !in_exact) {
      add_pixel(shown, exact, pixel, outline);
      continue;
    }
    ++figures.compared;
    const int largest = add_pixel(shown, exact, pixel, sums);
    figures.max_level = std::max(figures.max_level, largest);
    if (shown.object[pixel] == exact.object[pixel])
      figures.max_level_same_object = std::max(figures.max_level_same_object, largest);
    else
      ++figures.wrong_object;
  }
  const std::uint64_t either = figures.compared + figures.covered_missing + figures.covered_extra;
  figures.psnr_outline_db = psnr(sums.squares + outline.squares, either);
  if (figures.compared == 0) return figures;
  const double values = 3.0 * static_cast<double>(figures.compared);
  figures.rmse_level = std::sqrt(static_cast<double>(sums.squares) / values);
  figures.rmse_unrounded_level = std::sqrt(sums.unrounded_squares / values);
  figures.over_one_level_percent = 100.0 * static_cast<double>(sums.over_one) / static_cast<double>(figures.compared);
  figures.psnr_db = psnr(sums.squares, figures.compared);
  return figures;
}

double largest_depth_error(const frame::Frame& shown, const frame::ExactFrame& exact, double near_word,
                           double far_word) {
  require_same_size(shown, exact);
  double largest = 0.0;
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    if (shown.object[pixel] == 0 || shown.object[pixel] != exact.object[pixel]) continue;
    const double wanted = near_word + exact.depth[pixel] * (far_word - near_word);
    largest = std::max(largest, std::abs(static_cast<double>(shown.depth[pixel]) - wanted));
  }
  return largest;
}

}  // namespace rastertlm::reference
