// The timeline of a span unit's machine: units and links are watched while frames are drawn, the screen's lines follow
// from the video timing.
#pragma once

#include <string>
#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "src/run/timeline.h"

namespace rastertlm::run {

class QuadraticTimeline {
 public:
  // Before the platform runs, which it watches until then: it must outlive that. `frames`: displayed.
  QuadraticTimeline(const TimelineRange& range, std::uint64_t frames, quadratic::Quadratic& platform);
  QuadraticTimeline(const QuadraticTimeline&) = delete;
  QuadraticTimeline& operator=(const QuadraticTimeline&) = delete;

  // When the platform has run.
  Timeline close();

 private:
  void add_units();
  void add_frames();
  enum class Part { whole, pixels };  // of a line
  void add_screen(std::size_t line_track, std::size_t unit_track, std::size_t link_track);
  void add_lines(std::size_t track, std::uint64_t from_ps, std::uint64_t until_ps, Part part, const char* name);
  void add_limits(std::size_t track);
  void add_bus(std::size_t track);

  TimelineRange range_;
  quadratic::Quadratic& platform_;
  std::vector<WatchedSpan> set_up_;
  std::vector<std::vector<WatchedSpan>> span_units_;
  std::vector<WatchedSpan> memory_;
  std::vector<WatchedSpan> bus_;
  std::vector<WatchedSpan> pixels_;
  Timeline timeline_;
};

}  // namespace rastertlm::run
