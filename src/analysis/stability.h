// How far the steps of a machine are off on hard cases, beside what is proved of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/analysis/hard_case.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {

enum class BoundKind { proved, required };

// The input of all that were tried which came nearest to its bound, or went furthest beyond it.
struct Measurement {
  std::string what;
  std::string unit;
  double measured = 0.0;  // infinite where a step has no result
  double bound = 0.0;
  BoundKind kind = BoundKind::proved;
  bool holds() const { return measured <= bound; }
};

struct Finding {
  std::string name;      // the case's
  std::string stresses;  // as the case says
  std::string step;      // the parameter of the machine that decides: "span_unit.start_edge"
  std::vector<Measurement> measurements;
  bool holds() const;
};

// Nothing where the machine has no such step, or no bound is known for the number that it computes in (a set-up
// processor in fixed point). `tries` in place of the case's own; the same seed gives the same figures.
std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries);

}  // namespace rastertlm::analysis
