// report.json, schema 1: what tools read, and what the other reports are made from.
#pragma once

#include <string>

#include "src/report/schema.h"

namespace rastertlm::report {

// Keys in the order of schema.h; the same bytes for the same contents. Metrics have six significant digits, other reals
// nine; what is not finite is null.
std::string json_text(const Contents& contents);

// What json_text() was given, to the digits that it keeps. Keys that this program does not know are passed over. Throws
// InputError, naming `file` and all keys that are missing or of the wrong type; a schema that this program does not
// read is refused.
Contents read_json(const std::string& text, const std::string& file);

// Whether the text is a report.json of this program, of any schema.
bool is_report(const std::string& text);

}  // namespace rastertlm::report
