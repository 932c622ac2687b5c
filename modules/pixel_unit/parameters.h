// What a pixel unit is: declared once, here.
#pragma once

#include <cstdint>

#include "src/base/units.h"
#include "src/parameter/table.h"

namespace rastertlm::pixel_unit {

struct PixelUnitParameters {
  double clock_ns = 50.0;  // as the span unit's
  // From a pixel to the next, and from a triangle's first pixel to its levels. By default a unit without a pipeline
  // that takes as long as 003's software does: table 1, a frame's part that grows with the pixels, Phong's beside
  // Gouraud's (22.8 times).
  std::int64_t cycles_per_pixel = 23;
  std::int64_t latency_cycles = 23;
  std::int64_t cycles_per_line = 1;  // from a line to its first pixel
  std::int64_t load_cycles = 1;      // from a triangle to its first line

  // Paths "pixel_unit.clock_ns" ...
  void declare(parameter::Table& table);

  Clock clock() const { return Clock::from_period_ns("pixel unit", clock_ns); }
};

}  // namespace rastertlm::pixel_unit
