// What `describe parameters` prints, and the same as Markdown.
#pragma once

#include <string>

#include "src/parameter/table.h"

namespace rastertlm::config {

// Grouped by table: path, type, default, unit, what is accepted, meaning, what it moves and its condition; lists of
// tables after the rest, as [[light]]. The table views a configuration that nobody changed, as its values are the
// defaults.
std::string parameter_list_text(const parameter::Table& table);
std::string parameter_list_markdown(const parameter::Table& table);

}  // namespace rastertlm::config
