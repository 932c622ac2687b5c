// What a frame of a span unit's machine takes of each unit, and how many screens of pixels each unit could draw in the
// time of a frame.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "modules/frame_store/memory_limits.h"
#include "platforms/quadratic/quadratic.h"

namespace rastertlm::run {

// Seconds that a frame takes of each unit, were it alone.
struct FrameLoad {
  double arithmetic = 0.0;  // of the set-up processor
  double bus = 0.0;         // its words
  double clear = 0.0;       // of the buffer, which comes before its first triangle
  double span_unit = 0.0;   // loads, lines, pixels
  double pixel_unit = 0.0;  // loads, lines, pixels, where there is one
  double drawing =
      0.0;  // the span unit's, waiting for pixel unit and memory included; without shadow sets, for the words as well
  double memory = 0.0;    // clear, tests and writes, and the screen where it shares the port
  double pixels = 0.0;    // drawn, hidden ones included
  double accesses = 0.0;  // of the memory's busiest bank, clear included
  double set_up() const { return arithmetic + bus; }
  bool memory_is_slower() const { return memory - clear > std::max(span_unit, pixel_unit); }
  bool pixel_unit_is_slower() const { return pixel_unit > span_unit && !memory_is_slower(); }
  bool bus_is_slower() const { return bus > arithmetic; }
  // From the time at which the buffer is free.
  double cleared_and_drawn() const { return clear + drawing; }
};
FrameLoad frame_load(const quadratic::Quadratic& platform, const quadratic::ShownFrame& frame);

// Who takes longest of what is drawn: "span unit", "pixel unit" or "frame store".
const char* slower_of_drawing(const FrameLoad& load);

frame_store::MemoryLimits memory_limits(const quadratic::Quadratic& platform);
// Seconds that a frame may take: those of a video frame where frames are shown at retraces.
double frame_seconds(const quadratic::Quadratic& platform);
// One buffer that is shown whole before it is drawn again: every second video frame at best.
bool draws_in_turn_with_screen(const quadratic::Machine& machine);

// The depth complexity (pixels drawn / pixels of the screen) up to which a unit keeps the required rate, with triangles
// and hidden pixels in the frame's proportions.
struct ComplexityLimit {
  std::string name;      // of the budget
  std::string unit;      // that limits
  double screens = 0.0;  // infinite where the frame asks for nothing of the unit
  std::string formula;
  std::string moved_by;
};
// Of span unit, pixel unit where there is one, memory, all as they wait for each other, set-up processor, bus.
std::vector<ComplexityLimit> complexity_limits(const quadratic::Quadratic& platform,
                                               const quadratic::ShownFrame& frame);

// Of the run's frames, that which leaves the least.
struct WorstFrame {
  FrameLoad load;
  double complexity = 0.0;  // screens that it draws
  std::vector<ComplexityLimit> limits;
  std::size_t least_index = 0;  // of limits
  const ComplexityLimit& least() const { return limits[least_index]; }
};
WorstFrame worst_frame(const quadratic::Quadratic& platform);

}  // namespace rastertlm::run
