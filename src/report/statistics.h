// Every figure of report.json: its path, unit and meaning. What `describe statistics` prints.
#pragma once

#include <string>
#include <vector>

#include "src/parameter/statistic.h"

namespace rastertlm::report {

// In the order of the file; elements of lists as "links[].utilisation".
std::vector<parameter::Statistic> statistics();

// As a table.
std::string statistics_text();

}  // namespace rastertlm::report
