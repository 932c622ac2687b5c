// A point's picture, small. PNG by itself: the library of image files takes longer to load than a point to simulate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "src/frame/frame.h"

namespace rastertlm::explore {

inline constexpr std::size_t kThumbnailSize = 64;  // columns and lines

// The frame in 64 x 64 pixels, its shape kept between black bars; each pixel the mean of those that it covers.
std::string thumbnail(const frame::Frame& frame);

// 8-bit RGB, 3 bytes a pixel, row by row.
std::string png_of(const std::vector<std::uint8_t>& rgb, std::size_t columns, std::size_t lines);

}  // namespace rastertlm::explore
