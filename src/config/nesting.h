// What toml++ must not be given.
//
// It bounds the nesting of values but not the length of a dotted key, and walks both by recursion: a key of a
// million parts would exhaust the stack when its tables are released.
#pragma once

#include <string_view>

namespace rastertlm::config {

inline constexpr int kMaximumKeyDepth = 32;  // the deepest key of any schema has four parts

// The first line, from 1, with a key or a table header of more parts than that; 0 where there is none. Text that is not
// TOML is judged correctly up to its first error.
int line_of_excessive_nesting(std::string_view text);

// Likewise with a character beyond ASCII outside of strings and comments, where TOML knows none: of some toml++ 3.3
// takes for granted that they do not occur.
int line_of_foreign_character(std::string_view text);

}  // namespace rastertlm::config
