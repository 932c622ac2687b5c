// What the screen asks of the machine.
#pragma once

#include <cstdint>
#include <string>

#include "src/parameter/table.h"

namespace rastertlm::video {

inline constexpr double kFastestClockNs = 0.1;
inline constexpr double kSlowestRefreshHz = 0.01;  // a frame's clocks stay far below 2^53

struct VideoParameters {
  std::string preset = "512_50";
  std::int64_t columns = 512;
  std::int64_t lines = 512;
  double refresh_hz = 50.0;            // of interlaced video, fields
  double pixel_clock_ns = 60.0;        // 004, section 5.3.6
  double vertical_retrace_us = 600.0;  // 004, section 5.3.6
  bool interlaced = false;

  void declare(parameter::Table& table);
};

}  // namespace rastertlm::video
