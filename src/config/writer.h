// A configuration as a TOML file that reads back as the same values.
#pragma once

#include <string>

#include "src/config/origins.h"
#include "src/parameter/table.h"

namespace rastertlm::config {

// Every parameter of the table with its value and, as a comment, where the value came from; the elements of lists in
// order. A parameter that the chosen types do not have is a comment: reading it would be refused.
std::string resolved_text(parameter::Table& table, const Origins& origins);

// The same without comments and without what does not apply: equal for equal machines, whatever file or option they
// came from.
std::string canonical_text(parameter::Table& table);

// SHA-256 of the canonical text.
std::string digest(parameter::Table& table);

}  // namespace rastertlm::config
