// How far the steps of a machine are off on hard cases, beside what is proved of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/analysis/hard_case.h"
#include "src/report/stability_report.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {

using report::Finding;

// Nothing where the machine has no such step. `tries` in place of the case's own; the same seed gives the same figures,
// whatever else is measured.
std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries, const Tampering& tampering = {});

// What a case asks for when it is tried, and about what it costs.
struct CaseCost {
  double random_inputs = 0.0;  // of one try, on average: not every triangle has a pixel; 0: it draws none
  double try_us = 0.0;
};
// By some milliseconds of tries.
CaseCost cost_of(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed);

// How often to try each of these cases so that `inputs` are tried over all of them, and not many more: as long for
// each, so that most inputs go where they are cheap, but no case less often than kFewestTries.
inline constexpr std::int64_t kFewestTries = 20;
std::vector<std::int64_t> spread_inputs(const std::vector<CaseCost>& cases, std::int64_t inputs);

}  // namespace rastertlm::analysis
