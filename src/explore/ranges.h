// The values of a range.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "src/config/raw.h"
#include "src/explore/sweep_file.h"

namespace rastertlm::explore {

// Twelve significant digits: 0.1 + 2 * 0.1 is 0.3.
double rounded(double value);

struct RangeMistake {
  std::string key;  // within the [[vary]]
  std::string message;
};

// What `vary` at `prefix` ("vary[0].") of the sweep file spans: its values, or where it says of no steps and `drawn`,
// the span from which they are drawn. `integer`: the parameter takes whole numbers.
std::variant<std::vector<config::Raw>, Span, RangeMistake> range_of(const SweepFile& file, const VaryFile& vary,
                                                                    const std::string& prefix, bool integer,
                                                                    bool drawn);

// A value of a span at `fraction` of it, from 0 to 1.
config::Raw value_at(const Span& span, double fraction);

}  // namespace rastertlm::explore
