// Says so where a displayed frame shows nothing that the scene holds.
#pragma once

#include "src/run/result.h"

namespace rastertlm::run {

// Of the first such frame, and why if that is known.
void warn_of_background(Result& result);

}  // namespace rastertlm::run
