// What the command line sets: --set path=value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/config/raw.h"

namespace rastertlm::config {

struct Override {
  std::string path;          // "video.columns", "light[0].towards"
  std::string text;          // as given, for parameters that hold text
  std::optional<Raw> value;  // as a TOML value, where the text is one; otherwise bare text
};

// "path=value": integers, reals, true and false, quoted or bare text, [lists]. What is wrong goes to `diagnostics`, and
// then the result is empty.
std::optional<Override> parse_override(const std::string& argument, Diagnostics& diagnostics);

// All of them, in order; a later one wins.
std::vector<Override> parse_overrides(const std::vector<std::string>& arguments, Diagnostics& diagnostics);

}  // namespace rastertlm::config
