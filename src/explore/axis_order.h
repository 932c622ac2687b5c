// What a step is along an axis.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

// The value as a number: "8", "60.0", "-1e3", "1_000"; none of a name, a truth value or a list.
std::optional<double> number_of(const std::string& value);
// All of the axis's values as numbers, in its order; none where one is no number.
std::optional<std::vector<double>> numbers_of(const Axis& axis);

// The values one step from a value. Along numbers: the next smaller and the next larger that the sweep has, in this
// order, however the sweep lists them. Otherwise every other value, in the sweep's order: names have no neighbours.
std::vector<std::size_t> one_step_from(const Axis& axis, std::size_t value);

}  // namespace rastertlm::explore
