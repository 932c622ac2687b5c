// How far the steps of a machine are off on hard cases, beside what is proved of them.
#pragma once

#include <cstdint>
#include <optional>

#include "src/analysis/hard_case.h"
#include "src/report/stability_report.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {

using report::Finding;

// Nothing where the machine has no such step. `tries` in place of the case's own; the same seed gives the same figures,
// whatever else is measured.
std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries, const Tampering& tampering = {});

}  // namespace rastertlm::analysis
