#include "modules/video/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "src/base/errors.h"

namespace rastertlm::video {
namespace {

// The slowest pixel clock, to the picosecond, that leaves a clock of blanking on every line however the frame and its
// retrace are rounded to whole clocks; "" where no clock does.
std::string slowest_clock(const VideoParameters& parameters, std::uint64_t lines) {
  const double shown_ns = 1e9 / parameters.refresh_hz - 1e3 * parameters.vertical_retrace_us;
  const double clocks = static_cast<double>(lines) * static_cast<double>(parameters.columns + 1) + 1.0;
  const double clock_ns = std::floor(1e3 * shown_ns / clocks) * 1e-3;
  return clock_ns < kFastestClockNs ? "" : fmt::format("; at most {:.9g} ns would leave some", clock_ns);
}

}  // namespace

Timing timing(const VideoParameters& parameters) {
  Timing t;
  t.clock = Clock::from_period_ns("pixel clock", parameters.pixel_clock_ns);
  const auto columns = static_cast<std::uint64_t>(parameters.columns);
  t.fields = parameters.interlaced ? 2 : 1;
  if (static_cast<std::size_t>(parameters.lines) % t.fields != 0)
    throw InputError({"", 0, "video.lines",
                      fmt::format("is {}; an interlaced picture has as many odd lines as even ones, and an even number "
                                  "of lines",
                                  parameters.lines)});
  const std::uint64_t lines = static_cast<std::uint64_t>(parameters.lines) / t.fields;  // of a video frame
  t.frame = t.clock.cycles_round(1.0 / parameters.refresh_hz);
  const Cycles retrace = t.clock.cycles_round(parameters.vertical_retrace_us * 1e-6);
  if (retrace >= t.frame)
    throw InputError(
        {"", 0, "video.vertical_retrace_us",
         fmt::format("a retrace of {} us ({} pixel clocks) is not shorter than the frame of {} pixel clocks at {} Hz",
                     parameters.vertical_retrace_us, retrace.count(), t.frame.count(), parameters.refresh_hz)});
  t.line = Cycles((t.frame - retrace).count() / lines);
  if (t.line.count() <= columns)
    throw InputError(
        {"", 0, "video.pixel_clock_ns",
         fmt::format("a pixel clock of {} ns leaves {} clocks for a line of {} pixels, and no horizontal "
                     "blanking{}",
                     parameters.pixel_clock_ns, t.line.count(), columns, slowest_clock(parameters, lines))});
  t.vertical_retrace = t.frame - t.line * lines;
  t.horizontal_blanking = t.line - Cycles(columns);
  return t;
}

std::uint64_t Timing::pixels_sent(Cycles clocks, std::uint64_t lines) const {
  const std::uint64_t columns = (line - horizontal_blanking).count();
  const std::uint64_t within = clocks.count() % frame.count();
  std::uint64_t pixels = clocks.count() / frame.count() * lines * columns;
  if (within <= vertical_retrace.count()) return pixels;
  const std::uint64_t shown = within - vertical_retrace.count();
  const std::uint64_t whole = std::min(shown / line.count(), lines);
  pixels += whole * columns;
  if (whole < lines) pixels += shown % line.count() - std::min(shown % line.count(), horizontal_blanking.count());
  return pixels;
}

}  // namespace rastertlm::video
