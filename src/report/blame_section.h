// What made pixels wrong, for a reader.
#pragma once

#include <string>

#include "src/report/blame_figures.h"

namespace rastertlm::report {

// Of the frame that is farthest from the ideal picture; empty without frames.
std::string blame_section(const BlameContents& blame);

}  // namespace rastertlm::report
