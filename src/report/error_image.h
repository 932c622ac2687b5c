// The error of a picture as a picture.
#pragma once

#include <cstdint>
#include <vector>

#include "src/frame/frame.h"

namespace rastertlm::report {

inline constexpr int kErrorAmplification = 32;

// For each channel min(255, kErrorAmplification |shown - floor(exact + 1/2)|): 3 a pixel, as levels. Both of the same
// size.
std::vector<std::uint8_t> error_image(const frame::Frame& shown, const frame::ExactFrame& exact);

}  // namespace rastertlm::report
