#include "src/reference/metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "src/reference/error_meter.h"

namespace rastertlm::reference {

ErrorFigures compare(const frame::Frame& shown, const frame::ExactFrame& exact, const std::string& reference) {
  return ErrorMeter({reference}).measure(shown, exact);
}

double largest_depth_error(const frame::Frame& shown, const frame::ExactFrame& exact, double near_word,
                           double far_word) {
  if (shown.columns != exact.columns || shown.lines != exact.lines)
    throw std::invalid_argument("pictures of different sizes are compared");
  double largest = 0.0;
  for (std::size_t pixel = 0; pixel < exact.pixels(); ++pixel) {
    if (shown.object[pixel] == 0 || shown.object[pixel] != exact.object[pixel]) continue;
    const double wanted = near_word + exact.depth[pixel] * (far_word - near_word);
    largest = std::max(largest, std::abs(static_cast<double>(shown.depth[pixel]) - wanted));
  }
  return largest;
}

}  // namespace rastertlm::reference
