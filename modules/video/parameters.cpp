#include "modules/video/parameters.h"

namespace rastertlm::video {

void VideoParameters::declare(parameter::Table& table) {
  table.text("video.preset", preset,
             {.unit = "",
              .description = "Kind of screen: sets the video keys that the file does not.",
              .moves = "picture, answer.required_rate_hz"});
  table.integer(
      "video.columns", columns, {1, 16384},
      {.unit = "pixels", .description = "Pixels shown on a line.", .moves = "width of the picture, line cycles"});
  table.integer(
      "video.lines", lines, {1, 16384},
      {.unit = "lines", .description = "Lines shown in a frame.", .moves = "height of the picture, frame cycles"});
  table.real("video.refresh_hz", refresh_hz, {kSlowestRefreshHz, 1000.0},
             {.unit = "Hz",
              .description = "Frames that the screen asks for each second; of interlaced video, fields.",
              .moves = "answer.required_rate_hz"});
  table.real("video.pixel_clock_ns", pixel_clock_ns, {kFastestClockNs, 1e6},
             {.unit = "ns",
              .description = "Period of the pixel clock, which all boards share.",
              .moves = "budgets line_start, adder_delay"});
  table.real("video.vertical_retrace_us", vertical_retrace_us, {0.0, 1e6},
             {.unit = "us",
              .description = "Vertical retrace, in which loading RAMs are copied.",
              .moves = "budgets frame_start, pipeline_skew, deadlines.retrace"});
  table.boolean("video.interlaced", interlaced,
                {.unit = "",
                 .description = "Whether a frame is two fields, of its even lines and of its odd ones, each with a "
                                "retrace of its own.",
                 .moves = "picture, budgets line_start, deadlines.lines"});
}

}  // namespace rastertlm::video
