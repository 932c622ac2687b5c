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

constexpr double kHalfLevel = 0.5;

// Of the channels of a pixel.
struct PixelError {
  int largest = 0;
  int squares = 0;
  double unrounded_squares[3] = {};
};

PixelError error_of(const std::uint8_t* levels, const double* exact) {
  PixelError error;
  for (int c = 0; c < 3; ++c) {
    // Exact levels are not negative: cutting off is floor, which processors without SSE4.1 would have to call.
    const int difference = std::abs(levels[c] - static_cast<int>(exact[c] + kHalfLevel));
    const double unrounded = levels[c] - exact[c];
    error.largest = std::max(error.largest, difference);
    error.squares += difference * difference;
    error.unrounded_squares[c] = unrounded * unrounded;
  }
  return error;
}

struct Sums {
  std::uint64_t squares = 0;
  double unrounded_squares[3] = {};  // of each channel: three sums that need not wait for each other
  std::uint64_t over_one = 0;
  void add(const PixelError& error) {
    squares += static_cast<std::uint64_t>(error.squares);
    for (int c = 0; c < 3; ++c) unrounded_squares[c] += error.unrounded_squares[c];
    over_one += error.largest > 1 ? 1 : 0;
  }
};

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
  std::uint64_t outline = 0;  // squares of pixels that one picture alone covers
  const std::uint8_t* levels = shown.rgb.data();
  const double* wanted = exact.rgb.data();
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    const bool in_shown = shown.object[pixel] != 0;
    const bool in_exact = exact.object[pixel] != 0;
    figures.covered_missing += !in_shown && in_exact ? 1 : 0;
    figures.covered_extra += in_shown && !in_exact ? 1 : 0;
    if (!in_shown && !in_exact) continue;
    const PixelError error = error_of(levels + 3 * pixel, wanted + 3 * pixel);
    if (!in_shown || !in_exact) {
      outline += static_cast<std::uint64_t>(error.squares);
      continue;
    }
    ++figures.compared;
    sums.add(error);
    figures.max_level = std::max(figures.max_level, error.largest);
    if (shown.object[pixel] == exact.object[pixel])
      figures.max_level_same_object = std::max(figures.max_level_same_object, error.largest);
    else
      ++figures.wrong_object;
  }
  const std::uint64_t either = figures.compared + figures.covered_missing + figures.covered_extra;
  figures.psnr_outline_db = psnr(sums.squares + outline, either);
  if (figures.compared == 0) return figures;
  const double values = 3.0 * static_cast<double>(figures.compared);
  figures.rmse_level = std::sqrt(static_cast<double>(sums.squares) / values);
  figures.rmse_unrounded_level =
      std::sqrt((sums.unrounded_squares[0] + sums.unrounded_squares[1] + sums.unrounded_squares[2]) / values);
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
