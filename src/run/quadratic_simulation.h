// One simulation of a quadratic-shading machine.
#pragma once

#include "platforms/quadratic/machine.h"
#include "src/run/simulate.h"

namespace rastertlm::run {

Result simulate_quadratic(const quadratic::Machine& machine, const Inputs& inputs, const Options& options,
                          const FrameSink& sink);

}  // namespace rastertlm::run
