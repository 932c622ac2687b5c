#include "src/analysis/stability.h"

#include <utility>

namespace rastertlm::analysis {

std::optional<Finding> examine(const HardCase& hard_case, const run::Inputs::Content& machine, std::uint64_t seed,
                               std::optional<std::int64_t> tries, const Tampering& tampering) {
  Trial trial{machine, Numbers(seed), tries, tampering};
  Measured found = hard_case.core->measure(trial);
  if (found.empty()) return std::nullopt;
  return Finding{hard_case.name,
                 hard_case.kind,
                 hard_case.stresses,
                 hard_case.core->step(machine),
                 std::move(found.measurements),
                 std::move(found.notes)};
}

}  // namespace rastertlm::analysis
