#include "modules/video/timing.h"

#include <fmt/format.h>

#include "src/base/errors.h"

namespace rastertlm::video {

Timing timing(const VideoParameters& parameters) {
  Timing t;
  t.clock = Clock::from_period_ns("pixel clock", parameters.pixel_clock_ns);
  const auto columns = static_cast<std::uint64_t>(parameters.columns);
  const auto lines = static_cast<std::uint64_t>(parameters.lines);
  t.frame = t.clock.cycles_round(1.0 / parameters.refresh_hz);
  const Cycles retrace = t.clock.cycles_round(parameters.vertical_retrace_us * 1e-6);
  if (retrace >= t.frame)
    throw InputError(
        {"", 0, "video.vertical_retrace_us",
         fmt::format("a retrace of {} us ({} pixel clocks) is not shorter than the frame of {} pixel clocks at {} Hz",
                     parameters.vertical_retrace_us, retrace.count(), t.frame.count(), parameters.refresh_hz)});
  t.line = Cycles((t.frame - retrace).count() / lines);
  if (t.line.count() <= columns)
    throw InputError({"", 0, "video.pixel_clock_ns",
                      fmt::format("a pixel clock of {} ns leaves {} clocks for a line of {} pixels, and no horizontal "
                                  "blanking; at most {:.6g} ns would leave some",
                                  parameters.pixel_clock_ns, t.line.count(), columns,
                                  (1e9 / parameters.refresh_hz - 1e3 * parameters.vertical_retrace_us) /
                                      (static_cast<double>(lines) * static_cast<double>(columns + 1)))});
  t.vertical_retrace = t.frame - t.line * lines;
  t.horizontal_blanking = t.line - Cycles(columns);
  return t;
}

}  // namespace rastertlm::video
