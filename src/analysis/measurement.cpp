#include "src/analysis/measurement.h"

#include <cmath>
#include <limits>

namespace rastertlm::analysis {

namespace {

// What is no number is as far off as can be.
double or_infinite(double measured) {
  return std::isnan(measured) ? std::numeric_limits<double>::infinity() : measured;
}

}  // namespace

void keep_worst(Measurement& worst, double measured, double bound) {
  measured = or_infinite(measured);
  // measured / bound > worst.measured / worst.bound, also where a bound is 0.
  const bool first = worst.bound == 0.0 && worst.measured == 0.0;
  const bool infinite = std::isinf(measured) && !std::isinf(worst.measured);
  if (!first && !infinite && !(measured * worst.bound > worst.measured * bound)) return;
  worst.measured = measured;
  worst.bound = bound;
}

void keep_largest(Measurement& worst, double measured, double bound) {
  measured = or_infinite(measured);
  const double beyond = measured - bound, so_far = worst.measured - worst.bound;
  const bool broken = beyond > 0.0, was_broken = so_far > 0.0;
  const bool stays = broken != was_broken ? was_broken : (broken ? beyond <= so_far : measured <= worst.measured);
  if (stays) return;
  worst.measured = measured;
  worst.bound = bound;
}

}  // namespace rastertlm::analysis
