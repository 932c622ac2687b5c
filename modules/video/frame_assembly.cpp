#include "modules/video/frame_assembly.h"

#include <algorithm>
#include <cmath>

namespace rastertlm::video {
namespace {

// A one's complement word stands for the interval of its value; its centre is (2 m + 1) / 2, with the sign.
double centre(std::uint16_t word, unsigned normal_bits) {
  const unsigned sign = 1U << (normal_bits - 1);
  const double magnitude = 2.0 * (word & (sign - 1)) + 1.0;
  return (word & sign) != 0 ? -magnitude : magnitude;
}

}  // namespace

FrameAssembly::FrameAssembly(const Format& format) : format_(format) {
  if (format.observe) {
    frame_.resize(format.columns, format.lines);
    return;
  }
  frame_.columns = format.columns;
  frame_.lines = format.lines;
  frame_.rgb.assign(3 * frame_.pixels(), 0);
}

void FrameAssembly::add_line(std::size_t line, const frame::RgbLine& rgb, const frame::FragmentLine& fragments) {
  const auto at = static_cast<std::ptrdiff_t>(3 * line * format_.columns);
  std::copy(rgb.levels.begin(), rgb.levels.end(), frame_.rgb.begin() + at);
  if (format_.observe) observe(line, fragments);
}

void FrameAssembly::observe(std::size_t line, const frame::FragmentLine& fragments) {
  const std::size_t row = line * format_.columns;
  for (std::size_t x = 0; x < format_.columns; ++x) {
    const std::size_t pixel = row + x;
    const bool inside = x >= fragments.begin && x < fragments.end;
    const bool seen = inside && fragments.object[x] != 0;
    frame_.depth[pixel] = seen ? fragments.depth[x] : format_.background_depth;
    frame_.object[pixel] = seen ? fragments.object[x] : 0;
    frame_.material[pixel] = seen ? fragments.material[x] : 0;
    frame_.coverage[pixel] = inside ? fragments.coverage[x] : 0;
    if (!seen) {
      std::fill_n(frame_.normal.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, 0.0F);
      continue;
    }
    const double nx = centre(fragments.normal_x[x], format_.normal_bits);
    const double ny = centre(fragments.normal_y[x], format_.normal_bits);
    const double nz = centre(fragments.normal_z[x], format_.normal_bits);
    const double scale = 1.0 / std::sqrt(nx * nx + ny * ny + nz * nz);
    frame_.normal[3 * pixel] = static_cast<float>(nx * scale);
    frame_.normal[3 * pixel + 1] = static_cast<float>(ny * scale);
    frame_.normal[3 * pixel + 2] = static_cast<float>(nz * scale);
  }
}

}  // namespace rastertlm::video
