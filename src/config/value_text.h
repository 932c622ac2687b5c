// Values, types and ranges as text: what the reader says in messages, the writer puts in files and the descriptions
// list.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "src/config/raw.h"
#include "src/parameter/table.h"

namespace rastertlm::config {

// TOML. A real is the shortest text that reads back as the same double, and always has a point or an exponent. Long
// lists go one element a line.
std::string to_toml(const parameter::Value& value);
std::string to_toml(double value);
std::string to_toml(const std::string& text);

// A value as it was found, for messages: "the text \"x\"", "1.5", "a list of 2".
std::string found(const Raw& raw);

// What a parameter takes, with its unit: "from 1 to 16384 pixels", "above 0", "'a', 'b'"; "" where anything of its type
// is taken.
std::string accepted(const parameter::Parameter& parameter);

// "where type is 'uv_sphere' or 'teapot'"
std::string to_text(const parameter::Condition& condition);

bool is_utf8(std::string_view text);
// On one line and valid UTF-8: control characters, and every byte that is not ASCII in text that is not UTF-8, become
// '?'.
std::string printable(std::string_view text);

}  // namespace rastertlm::config
