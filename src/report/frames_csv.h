// frames.csv: a row a displayed frame.
#pragma once

#include <string>

#include "src/run/result.h"

namespace rastertlm::report {

// A header with the units, then the figures of every frame; those of the references follow, as "ideal_rmse_level". A
// field is empty where a frame was not compared, or where its PSNR is infinite.
std::string frames_csv(const run::Result& result);

}  // namespace rastertlm::report
