// The errors of all frames of a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/reference/error_summary.h"
#include "src/run/result.h"

namespace rastertlm::report {

// The references with which frames were compared, in the order of the first frame that has them.
std::vector<std::string> references_of(const run::Result& result);

// Of each of them.
std::vector<reference::ErrorSummary> summaries_of(const run::Result& result);

// The worst of each figure over all frames. Empty where no frame was compared with that reference.
std::optional<reference::ErrorFigures> worst_of(const run::Result& result, const std::string& reference);

}  // namespace rastertlm::report
