// The figures that objectives and constraints name: of report.json, or "machine.PATH", a number of the machine itself.
#pragma once

#include <optional>
#include <string>

#include "src/report/figure_path.h"

namespace rastertlm::explore {

// "host.computation_units" of "machine.host.computation_units"; "" of a figure of the report.
std::string parameter_of(const std::string& path);

// A figure of a point, from its report and its resolved machine, as a file. A truth is 1 or 0.
std::optional<double> figure_of(const std::string& path, const report::Figures& report,
                                const std::string& machine_toml);

}  // namespace rastertlm::explore
