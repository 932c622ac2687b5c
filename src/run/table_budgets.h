// What loading the shading tables needs of the retrace or of a frame.
#pragma once

#include <string>
#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

// The parameters that a load moves with.
inline constexpr const char* kLoaderKeys = "loader.kind, loader.when, the loader's clocks, loops and units";

void add_table_budgets(imogene::Imogene& platform, std::vector<Budget>& budgets);

// A load that is late for the retrace shows a wrong picture; one into the second bank, the old picture again.
bool late_tables_are_shown(const imogene::Machine& machine);

// What is to be said of lines that were shaded from half-written tables; "" where there are none.
std::string late_tables_warning(imogene::Imogene& platform, const std::vector<FrameFigures>& frames);

}  // namespace rastertlm::run
