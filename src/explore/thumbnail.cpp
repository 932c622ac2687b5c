#include "src/explore/thumbnail.h"

#include <algorithm>

namespace rastertlm::explore {
namespace {

// Where the source pixels of each cell begin, and where the last one's end: at least one is in each, shared by cells
// where there are more cells than pixels.
struct Cells {
  std::size_t pixels, cells;
  std::size_t begin(std::size_t cell) const { return cell * pixels / cells; }
  std::size_t end(std::size_t cell) const { return std::max(begin(cell) + 1, (cell + 1) * pixels / cells); }
};

// Adds the levels of a source line to the sums of its cells, three channels a cell.
void add_line(const std::uint8_t* line, const Cells& across, std::vector<std::size_t>& sums) {
  for (std::size_t x = 0; x < across.cells; ++x) {
    std::size_t* const sum = &sums[3 * x];
    const std::uint8_t* const end = line + 3 * across.end(x);
    for (const std::uint8_t* pixel = line + 3 * across.begin(x); pixel < end; pixel += 3)
      for (std::size_t channel = 0; channel < 3; ++channel) sum[channel] += pixel[channel];
  }
}

}  // namespace

std::string thumbnail(const frame::Frame& frame) {
  const std::size_t longest = std::max<std::size_t>({frame.columns, frame.lines, 1});
  const Cells across{frame.columns, std::max<std::size_t>(1, kThumbnailSize * frame.columns / longest)};
  const Cells down{frame.lines, std::max<std::size_t>(1, kThumbnailSize * frame.lines / longest)};
  const std::size_t left = (kThumbnailSize - across.cells) / 2;
  const std::size_t top = (kThumbnailSize - down.cells) / 2;
  std::vector<std::uint8_t> rgb(3 * kThumbnailSize * kThumbnailSize, 0);
  std::vector<std::size_t> sums;
  for (std::size_t y = 0; frame.pixels() > 0 && y < down.cells; ++y) {
    sums.assign(3 * across.cells, 0);
    for (std::size_t line = down.begin(y); line < down.end(y); ++line)
      add_line(&frame.rgb[3 * line * frame.columns], across, sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::size_t count = (across.end(i / 3) - across.begin(i / 3)) * (down.end(y) - down.begin(y));
      rgb[3 * ((top + y) * kThumbnailSize + left) + i] = static_cast<std::uint8_t>((sums[i] + count / 2) / count);
    }
  }
  return png_of(rgb, kThumbnailSize, kThumbnailSize);
}

}  // namespace rastertlm::explore
