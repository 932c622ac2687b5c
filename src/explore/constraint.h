// What a point must meet, as a sweep file writes it: "answer.sustained", "images[0].error.rmse_level <= 0.5".
#pragma once

#include <string>
#include <variant>

#include "src/explore/sweep.h"

namespace rastertlm::explore {

// What is wrong with a text that is none: a sentence. Whether the machine has a parameter "machine.PATH" is not seen.
std::variant<Constraint, std::string> parse_constraint(const std::string& text);

}  // namespace rastertlm::explore
