#include "src/analysis/stability.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "src/analysis/stability_cores.h"

namespace rastertlm::analysis {
namespace {

const quadratic::Machine* span_machine(const run::Inputs::Content& content) {
  if (const auto* machine = std::get_if<quadratic::Machine>(&content.machine)) return machine;
  return std::get_if<adaptive::Machine>(&content.machine);
}

const char* step_of(CaseKind kind) {
  switch (kind) {
    case CaseKind::forward_differences:
      return "span_unit.fraction_bits";
    case CaseKind::start_edge:
      return "span_unit.start_edge";
    case CaseKind::quadratic_solver:
      return "set_up.solver";
    case CaseKind::coverage:
      return "set_up.snap_bits";
    case CaseKind::linear_form:
      break;
  }
  return "ep1.carry_clock";
}

}  // namespace

bool Finding::holds() const {
  return std::all_of(measurements.begin(), measurements.end(), [](const Measurement& m) { return m.holds(); });
}

void keep_worst(Measurement& worst, double measured, double bound) {
  // measured / bound > worst.measured / worst.bound, also where a bound is 0.
  const bool first = worst.bound == 0.0 && worst.measured == 0.0;
  const bool infinite = std::isinf(measured) && !std::isinf(worst.measured);
  if (!first && !infinite && !(measured * worst.bound > worst.measured * bound)) return;
  worst.measured = measured;
  worst.bound = bound;
}

std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries) {
  Finding finding{hard_case.name, hard_case.stresses, step_of(hard_case.kind), {}};
  Numbers numbers(seed);
  const std::int64_t count = tries.value_or(hard_case.tries);
  if (hard_case.kind == CaseKind::linear_form) {
    const auto* object = std::get_if<imogene::Machine>(&machine.machine);
    if (object == nullptr) return std::nullopt;
    finding.measurements = measure_linear_form(object->object_processor, numbers, count);
    return finding;
  }
  const quadratic::Machine* const span = span_machine(machine);
  if (span == nullptr) return std::nullopt;
  if (hard_case.kind == CaseKind::forward_differences)
    finding.measurements = measure_differences(hard_case, *span, numbers, count);
  if (hard_case.kind == CaseKind::start_edge) finding.measurements = measure_start_edge(*span, numbers, count);
  if (hard_case.kind == CaseKind::quadratic_solver)
    finding.measurements = measure_solver(hard_case, *span, numbers, count);
  if (hard_case.kind == CaseKind::coverage) finding.measurements = measure_coverage(hard_case, *span);
  if (finding.measurements.empty()) return std::nullopt;
  return finding;
}

}  // namespace rastertlm::analysis
