// What a frame of a span unit's machine takes when set-up, clear and drawing have waited for each other: measured,
// where loads of single units (drawing_limits.h) are of each alone.
#pragma once

#include <string>

#include "platforms/quadratic/quadratic.h"
#include "src/run/budget.h"

namespace rastertlm::run {

// In seconds, of the run's frames but the first, which nothing is before: the slowest where retraces show them, else
// their mean.
struct InTurn {
  double frame = 0.0;    // from the time at which the frame before is shown to that at which it is whole
  double held_up = 0.0;  // set-up had no register set to write to
  double starved = 0.0;  // a span unit had no load to draw
};
InTurn in_turn(const quadratic::Quadratic& platform);

// "frame.in_turn": fits where the simulated rate is the required one.
Budget in_turn_budget(const quadratic::Quadratic& platform);

// Who waits for whom and how long, and what moves it: where the rate is missed although each unit alone keeps it.
std::string what_waits(const quadratic::Quadratic& platform);

// The least of required rate and what the display obtains of it in whole pixel clocks, in Hz.
double attainable_rate(const quadratic::Quadratic& platform);

}  // namespace rastertlm::run
