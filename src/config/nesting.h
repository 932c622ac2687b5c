// toml++ bounds the nesting of values but not the length of a dotted key, and walks both by recursion: a key of a
// million parts would exhaust the stack when its tables are released.
#pragma once

#include <string_view>

namespace rastertlm::config {

inline constexpr int kMaximumKeyDepth = 32;  // the deepest key of any schema has four parts

// The first line, from 1, with a key or a table header of more parts than that; 0 where there is none. Text that is not
// TOML is judged correctly up to its first error.
int line_of_excessive_nesting(std::string_view text);

}  // namespace rastertlm::config
