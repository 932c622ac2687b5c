// Rows of a table that differ in a number only, as one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rastertlm::report {

// A machine may have thousands of like units: no more rows of a kind are printed.
inline constexpr std::size_t kMostRowsOfAKind = 16;

// The first cell of a row is a name. Neighbours whose names count up, "board 0 to shading", "board 1 to shading", and
// whose other cells are equal, become one row, "board 0-1 to shading"; of what is left, names that differ in their
// first number are of one kind: after kMostRowsOfAKind of them a row says how many more there are.
std::vector<std::vector<std::string>> merged_rows(const std::vector<std::vector<std::string>>& rows);

}  // namespace rastertlm::report
