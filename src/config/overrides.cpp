#include "src/config/overrides.h"

#include <fmt/format.h>

#include <utility>

#include "src/config/document.h"
#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::optional<Override> parse_override(const std::string& argument, Diagnostics& diagnostics) {
  const std::size_t equals = argument.find('=');
  const std::string path = trimmed(argument.substr(0, equals));
  if (equals == std::string::npos || path.empty()) {
    diagnostics.add({"--set", 0, "", fmt::format("'{}' is not of the form path=value", printable(argument))});
    return std::nullopt;
  }
  Override result{path, trimmed(argument.substr(equals + 1)), std::nullopt};
  if (!is_utf8(result.text)) {
    diagnostics.add({"--set", 0, printable(path), "the value is not valid UTF-8"});
    return std::nullopt;
  }
  result.value = parse_value(result.text);
  // Bare text may hold anything, but what begins as a list, a table or a quotation was meant as one.
  if (!result.value && !result.text.empty() && std::string("[{\"'").find(result.text[0]) != std::string::npos) {
    diagnostics.add({"--set", 0, printable(path), fmt::format("'{}' is not a valid value", printable(result.text))});
    return std::nullopt;
  }
  return result;
}

std::vector<Override> parse_overrides(const std::vector<std::string>& arguments, Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  for (const std::string& argument : arguments)
    if (std::optional<Override> one = parse_override(argument, diagnostics)) overrides.push_back(std::move(*one));
  return overrides;
}

}  // namespace rastertlm::config
