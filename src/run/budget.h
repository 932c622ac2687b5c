// A budget from what is used and what there is.
#pragma once

#include <string>

#include "src/run/result.h"

namespace rastertlm::run {

inline Budget budget(const std::string& name, double used, double available, const std::string& unit,
                     const std::string& source, const std::string& moved_by, bool applies = true) {
  return {name, used, available, unit, used <= available, applies, source, moved_by};
}

}  // namespace rastertlm::run
