// The part of report.txt that says how far the pictures are from the exact ones.
#pragma once

#include <optional>
#include <string>

#include "src/run/result.h"

namespace rastertlm::report {

// The worst of each figure over all frames. Empty where no frame was compared with that reference.
std::optional<reference::ErrorFigures> worst_of(const run::Result& result, const std::string& reference);

// The references with which frames were compared, in the order of the first frame that has them.
std::vector<std::string> references_of(const run::Result& result);

// "53.9 dB", "infinite", or "nothing to compare" where there are no pixels.
std::string decibels(const std::optional<double>& value, std::uint64_t pixels);

std::string error_section(const run::Result& result);

}  // namespace rastertlm::report
