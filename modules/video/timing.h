// Video timing in whole pixel clocks. A video frame is what passes from one vertical retrace to the next: the retrace,
// followed by lines; a line is its horizontal blanking followed by its pixels. What does not divide joins the vertical
// retrace, so that the rate is never below the one that whole lines would give.
//
// Where the video is interlaced a displayed frame is two video frames, its fields: the even lines, then the odd ones.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/video/parameters.h"
#include "src/base/units.h"

namespace rastertlm::video {

struct Timing {
  Clock clock;
  std::size_t fields = 1;      // video frames of a displayed frame: 2 where interlaced
  Cycles frame;                // of a video frame: round(1 / (refresh * period))
  Cycles vertical_retrace;     // round(retrace / period) + what is left over by the lines
  Cycles line;                 // floor((frame - round(retrace / period)) / (lines / fields))
  Cycles horizontal_blanking;  // line - columns, at the start of the line

  // Cycles from the start of its video frame to the start of line `line_number` of the picture, and to its first pixel.
  Cycles line_start(std::size_t line_number) const { return vertical_retrace + line * (line_number / fields); }
  Cycles first_pixel(std::size_t line_number) const { return line_start(line_number) + horizontal_blanking; }
  // Lines of the picture from the one that was last shown to this one; the first is one on from what the retrace
  // leaves.
  std::uint64_t lines_advanced(std::size_t line_number) const { return line_number == 0 ? 1 : fields; }
  // Pixels that the display has been sent in the first `clocks` clocks, where the video is not interlaced.
  std::uint64_t pixels_sent(Cycles clocks, std::uint64_t lines) const;
  double obtained_refresh_hz() const { return clock.frequency_hz() / static_cast<double>(frame.count()); }
};

// Throws InputError where the retrace does not fit the frame, the pixels do not fit the line, or lines cannot be dealt
// to two fields.
Timing timing(const VideoParameters& parameters);

}  // namespace rastertlm::video
