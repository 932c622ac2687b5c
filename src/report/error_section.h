// The part of report.txt that says how far the pictures are from the exact ones.
#pragma once

#include <optional>
#include <string>

#include "src/run/result.h"

namespace rastertlm::report {

// "53.9 dB", "infinite", or "nothing to compare" where there are no pixels.
std::string decibels(const std::optional<double>& value, std::uint64_t pixels);

std::string error_section(const run::Result& result);

}  // namespace rastertlm::report
