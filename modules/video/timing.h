// Video timing in whole pixel clocks: a frame is its vertical retrace followed by its lines; a line is its horizontal
// blanking followed by its pixels. What does not divide joins the vertical retrace, so that the rate is never below the
// one that whole lines would give.
#pragma once

#include "modules/video/parameters.h"
#include "src/base/units.h"

namespace rastertlm::video {

struct Timing {
  Clock clock;
  Cycles frame;                // round(1 / (refresh * period))
  Cycles vertical_retrace;     // round(retrace / period) + what is left over by the lines
  Cycles line;                 // floor((frame - round(retrace / period)) / lines)
  Cycles horizontal_blanking;  // line - columns, at the start of the line

  // Cycles from the start of the frame to the start of line `line`, and to its first pixel.
  Cycles line_start(std::size_t line_number) const { return vertical_retrace + line * line_number; }
  Cycles first_pixel(std::size_t line_number) const { return line_start(line_number) + horizontal_blanking; }
  double obtained_refresh_hz() const { return clock.frequency_hz() / static_cast<double>(frame.count()); }
};

// Throws InputError where the retrace does not fit the frame, or the pixels do not fit the line.
Timing timing(const VideoParameters& parameters);

}  // namespace rastertlm::video
