#include "src/explore/thumbnail.h"

#include <algorithm>

namespace rastertlm::explore {
namespace {

// The mean of a channel over the source pixels of a cell of a grid of `columns` x `lines`.
std::uint8_t mean(const frame::Frame& frame, std::size_t columns, std::size_t lines, std::size_t x, std::size_t y,
                  std::size_t channel) {
  const std::size_t left = x * frame.columns / columns;
  const std::size_t right = std::max(left + 1, (x + 1) * frame.columns / columns);
  const std::size_t top = y * frame.lines / lines;
  const std::size_t bottom = std::max(top + 1, (y + 1) * frame.lines / lines);
  std::size_t sum = 0;
  for (std::size_t line = top; line < bottom; ++line)
    for (std::size_t column = left; column < right; ++column)
      sum += frame.rgb[3 * (line * frame.columns + column) + channel];
  const std::size_t count = (right - left) * (bottom - top);
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

}  // namespace

std::string thumbnail(const frame::Frame& frame) {
  const std::size_t longest = std::max<std::size_t>({frame.columns, frame.lines, 1});
  const std::size_t columns = std::max<std::size_t>(1, kThumbnailSize * frame.columns / longest);
  const std::size_t lines = std::max<std::size_t>(1, kThumbnailSize * frame.lines / longest);
  const std::size_t left = (kThumbnailSize - columns) / 2;
  const std::size_t top = (kThumbnailSize - lines) / 2;
  std::vector<std::uint8_t> rgb(3 * kThumbnailSize * kThumbnailSize, 0);
  if (frame.pixels() > 0)
    for (std::size_t y = 0; y < lines; ++y)
      for (std::size_t x = 0; x < columns; ++x)
        for (std::size_t channel = 0; channel < 3; ++channel)
          rgb[3 * ((top + y) * kThumbnailSize + left + x) + channel] = mean(frame, columns, lines, x, y, channel);
  return png_of(rgb, kThumbnailSize, kThumbnailSize);
}

}  // namespace rastertlm::explore
