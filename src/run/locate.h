// Where a value that is wrong was written: mistakes that are found after reading name a key, and the key's origin names
// file and line.
#pragma once

#include <string>

#include "src/base/errors.h"
#include "src/config/origins.h"

namespace rastertlm::run {

// The diagnostic with the line of its key, or of the nearest table above it that was given; without one, with `file`
// alone.
Diagnostic located(Diagnostic diagnostic, const config::Origins& origins, const std::string& file);

}  // namespace rastertlm::run
