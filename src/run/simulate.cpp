#include "src/run/simulate.h"

#include <variant>

#include "src/run/imogene_simulation.h"
#include "src/run/inputs.h"
#include "src/run/quadratic_simulation.h"

namespace rastertlm::run {
namespace {

Result simulate_machine(const imogene::Machine& machine, const Inputs& inputs, const Options& options,
                        const FrameSink& sink) {
  return simulate_imogene(machine, inputs, options, sink);
}
Result simulate_machine(const quadratic::Machine& machine, const Inputs& inputs, const Options& options,
                        const FrameSink& sink) {
  return simulate_quadratic(machine, inputs, options, sink);
}

}  // namespace

Result simulate(const Inputs& inputs, const Options& options, const FrameSink& sink) {
  return std::visit([&](const auto& machine) { return simulate_machine(machine, inputs, options, sink); },
                    inputs.content->machine);
}

}  // namespace rastertlm::run
