// What parameters do, as CSV: a header, then a row each; lines end in '\n', numbers have nine significant digits, what
// is missing is empty. Points are called by their numbers.
#pragma once

#include <string>
#include <vector>

#include "src/explore/sensitivity.h"
#include "src/explore/sweep_table.h"
#include "src/explore/what_if.h"

namespace rastertlm::explore {

// A row an objective, axis and value: objective, unit, parameter, value, points, effects (by_value, by_line,
// undetermined), difference (from the reference), reference, share (of the figure's variance, of the axis).
std::string sensitivity_csv(const SweepTable& table, const std::vector<ObjectiveSensitivity>& sensitivity);
// A row a move: parameter, from, to, state, point, and per objective by path the figure's change (not the gain).
std::string what_if_csv(const SweepTable& table, const WhatIf& what_if);

}  // namespace rastertlm::explore
