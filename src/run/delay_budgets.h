// What must settle within a clock period.
#pragma once

#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

void add_delay_budgets(const imogene::Imogene& platform, std::vector<Budget>& budgets);

}  // namespace rastertlm::run
