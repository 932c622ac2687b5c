// What to say about a key that nobody declares.
#pragma once

#include <string>

#include "src/config/tree.h"

namespace rastertlm::config {

// "unknown key 'x'; nearest known: 'y'", or that elements of lists there have a key of that name, or the keys known at
// that place where none is near. `place` is what the path was located as.
std::string unknown_key_message(const std::string& path, const Place& place);

}  // namespace rastertlm::config
