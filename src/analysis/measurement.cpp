#include "src/analysis/measurement.h"

#include <cmath>

namespace rastertlm::analysis {

void keep_worst(Measurement& worst, double measured, double bound) {
  // measured / bound > worst.measured / worst.bound, also where a bound is 0.
  const bool first = worst.bound == 0.0 && worst.measured == 0.0;
  const bool infinite = std::isinf(measured) && !std::isinf(worst.measured);
  if (!first && !infinite && !(measured * worst.bound > worst.measured * bound)) return;
  worst.measured = measured;
  worst.bound = bound;
}

}  // namespace rastertlm::analysis
