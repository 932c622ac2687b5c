#include "src/config/header.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/config/value_text.h"

namespace rastertlm::config {
namespace {

template <class T>
std::optional<T> as(const Raw& raw) {
  const T* value = std::get_if<T>(&raw.value);
  return value == nullptr ? std::nullopt : std::optional<T>(*value);
}

const Override* last(const std::vector<Override>& overrides, const std::string& path) {
  const auto given =
      std::find_if(overrides.rbegin(), overrides.rend(), [&](const Override& one) { return one.path == path; });
  return given == overrides.rend() ? nullptr : &*given;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", word);
  return text;
}

}  // namespace

std::optional<std::int64_t> peek_schema(const Document& document, const std::vector<Override>& overrides) {
  if (const Override* given = last(overrides, "schema"))
    return given->value ? as<std::int64_t>(*given->value) : std::nullopt;
  const Entry* entry = document.find("schema");
  return entry == nullptr ? std::nullopt : as<std::int64_t>(entry->value);
}

std::optional<std::string> peek_platform(const Document& document, const std::vector<Override>& overrides) {
  if (const Override* given = last(overrides, "platform")) {
    const std::optional<std::string> quoted = given->value ? as<std::string>(*given->value) : std::nullopt;
    return quoted ? quoted : given->text;
  }
  const Entry* entry = document.find("platform");
  return entry == nullptr ? std::nullopt : as<std::string>(entry->value);
}

std::optional<std::string> choose_platform(const Document& document, const std::vector<Override>& overrides,
                                           const std::vector<std::string>& known, Diagnostics& diagnostics) {
  const bool is_set = last(overrides, "platform") != nullptr;
  const Entry* entry = document.find("platform");
  Diagnostic wrong{is_set ? "--set" : document.file(), is_set || entry == nullptr ? 0 : entry->line, "platform", ""};
  std::optional<std::string> platform = peek_platform(document, overrides);
  if (platform && std::find(known.begin(), known.end(), *platform) != known.end()) return platform;
  if (platform) {
    wrong.message = fmt::format("'{}' is not accepted; accepted values: {}", printable(*platform), quoted_list(known));
    if (const std::string near = nearest_word(*platform, known); !near.empty())
      wrong.message += fmt::format("; nearest: '{}'", near);
  } else if (entry != nullptr) {
    wrong.message = fmt::format("wrong type: expected text in quotes, found {}; accepted values: {}",
                                found(entry->value), quoted_list(known));
  } else {
    wrong.message = "required key is missing; accepted values: " + quoted_list(known);
  }
  diagnostics.add(std::move(wrong));
  return std::nullopt;
}

bool check_schema(const Document& document, std::int64_t supported, Diagnostics& diagnostics) {
  const std::optional<std::int64_t> schema = peek_schema(document);
  if (schema == supported) return true;
  const Entry* entry = document.find("schema");
  std::string message = fmt::format("required key is missing: write schema = {}", supported);
  if (schema)
    message = fmt::format("schema {} is not known: this program reads schema {}", *schema, supported);
  else if (entry != nullptr)
    message = fmt::format("wrong type: expected the integer {}, found {}", supported, found(entry->value));
  diagnostics.add({document.file(), entry == nullptr ? 0 : entry->line, "schema", std::move(message)});
  return false;
}

}  // namespace rastertlm::config
