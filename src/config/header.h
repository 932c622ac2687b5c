// What a file says about itself, read before the table that it is checked against can be chosen.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/base/errors.h"
#include "src/config/document.h"
#include "src/config/overrides.h"

namespace rastertlm::config {

// Empty: not given, or not of the right type. An override goes before the document.
std::optional<std::int64_t> peek_schema(const Document& document, const std::vector<Override>& overrides = {});
std::optional<std::string> peek_platform(const Document& document, const std::vector<Override>& overrides = {});

// The platform that the document or an override names. Empty, with what is wrong in `diagnostics`, where it is missing,
// is not text, or is none of `known`.
std::optional<std::string> choose_platform(const Document& document, const std::vector<Override>& overrides,
                                           const std::vector<std::string>& known, Diagnostics& diagnostics);

// Whether the document is of the one schema that this program reads; a missing schema is a mistake. Does not look at
// overrides: the schema is a property of the file.
bool check_schema(const Document& document, std::int64_t supported, Diagnostics& diagnostics);

}  // namespace rastertlm::config
