#include "src/report/error_image.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace rastertlm::report {

std::vector<std::uint8_t> error_image(const frame::Frame& shown, const frame::ExactFrame& exact) {
  if (shown.rgb.size() != exact.rgb.size()) throw std::invalid_argument("error_image: pictures of different sizes");
  std::vector<std::uint8_t> levels(shown.rgb.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const int difference = std::abs(shown.rgb[i] - exact.rgb.rounded(i));
    levels[i] = static_cast<std::uint8_t>(std::min(kErrorAmplification * difference, 255));
  }
  return levels;
}

}  // namespace rastertlm::report
