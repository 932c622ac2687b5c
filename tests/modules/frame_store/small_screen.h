// A screen of 20 x 6 pixels whose video frame is 500 clocks of 100 ns: a retrace of 50, and six lines of 75.
#pragma once

#include "modules/video/timing.h"

namespace rastertlm::frame_store {

inline video::Timing small_screen() {
  video::VideoParameters parameters;
  parameters.columns = 20;
  parameters.lines = 6;
  parameters.refresh_hz = 20000;
  parameters.pixel_clock_ns = 100;
  parameters.vertical_retrace_us = 5;
  return video::timing(parameters);
}

}  // namespace rastertlm::frame_store
