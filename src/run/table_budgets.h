// What loading the shading tables needs of the retrace or of a frame.
#pragma once

#include <vector>

#include "platforms/imogene/imogene.h"
#include "src/run/result.h"

namespace rastertlm::run {

// The parameters that a load moves with.
inline constexpr const char* kLoaderKeys = "loader.kind, loader.when, the loader's clocks and cycles";

void add_table_budgets(imogene::Imogene& platform, std::vector<Budget>& budgets);

}  // namespace rastertlm::run
