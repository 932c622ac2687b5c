// One simulation of an object machine.
#pragma once

#include "platforms/imogene/machine.h"
#include "src/run/simulate.h"

namespace rastertlm::run {

Result simulate_imogene(const imogene::Machine& machine, const Inputs& inputs, const Options& options,
                        const FrameSink& sink);

}  // namespace rastertlm::run
