#include "src/explore/ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace rastertlm::explore {
namespace {

constexpr double kMostValues = 1e6;
constexpr double kSlack = 1e-9;  // of a step: what sums of steps may be off by

config::Raw raw_of(double value, bool integer) {
  if (integer) return {static_cast<std::int64_t>(std::llround(value))};
  return {rounded(value)};
}

// A range's values are rounded to whole numbers where the parameter takes no others; a value is there once.
std::vector<config::Raw> values_of(const std::vector<double>& numbers, bool integer) {
  std::vector<config::Raw> values;
  double last = 0.0;
  for (const double number : numbers) {
    const double value = integer ? std::round(number) : rounded(number);
    if (!values.empty() && value == last) continue;
    values.push_back(raw_of(value, integer));
    last = value;
  }
  return values;
}

std::vector<double> by_steps(const VaryFile& vary) {
  std::vector<double> numbers;
  const double steps = std::floor((vary.to - vary.from) / vary.step + kSlack);
  for (double i = 0.0; i <= steps; i += 1.0) numbers.push_back(vary.from + i * vary.step);
  return numbers;
}

std::vector<double> by_factors(const VaryFile& vary) {
  std::vector<double> numbers;
  const double steps = std::floor(std::log(vary.to / vary.from) / std::log(vary.factor) + kSlack);
  for (double i = 0.0; i <= steps; i += 1.0) numbers.push_back(vary.from * std::pow(vary.factor, i));
  return numbers;
}

double between(double from, double to, bool logarithmic, double fraction) {
  if (logarithmic) return from * std::pow(to / from, fraction);
  return from + (to - from) * fraction;
}

std::vector<double> by_count(const VaryFile& vary) {
  std::vector<double> numbers;
  for (std::int64_t i = 0; i < vary.count; ++i)
    numbers.push_back(between(vary.from, vary.to, vary.spacing == Spacing::logarithmic,
                              static_cast<double>(i) / static_cast<double>(vary.count - 1)));
  return numbers;
}

bool is_whole(double value) { return std::fabs(value - std::round(value)) <= kSlack * std::max(1.0, std::fabs(value)); }

}  // namespace

double rounded(double value) { return std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr); }

std::variant<std::vector<config::Raw>, Span, RangeMistake> range_of(const SweepFile& file, const VaryFile& vary,
                                                                    const std::string& prefix, bool integer,
                                                                    bool drawn) {
  const auto gives = [&](const char* key) { return file.gives(prefix + key); };
  const int ways =
      static_cast<int>(gives("step")) + static_cast<int>(gives("factor")) + static_cast<int>(gives("count"));
  const bool logarithmic = gives("factor") || vary.spacing == Spacing::logarithmic;
  for (const char* key : {"from", "to"})
    if (!gives(key)) return RangeMistake{key, "required key is missing: a range has a first and a last value"};
  if (vary.from > vary.to)
    return RangeMistake{"to", fmt::format("the range is empty: from {} to {}", vary.from, vary.to)};
  if (ways > 1) return RangeMistake{"", "step, factor and count contradict each other: give one of them"};
  if (ways == 0 && !drawn)
    return RangeMistake{"",
                        "a range needs a step, a factor or a count (random designs alone draw from ranges without)"};
  if (logarithmic && vary.from <= 0.0)
    return RangeMistake{"from", fmt::format("log steps begin above 0, not at {}", vary.from)};
  if (integer && (!is_whole(vary.from) || !is_whole(vary.to) || (gives("step") && !is_whole(vary.step))))
    return RangeMistake{"", "the parameter takes whole numbers: write from, to and step without a fraction"};
  if (ways == 0) return Span{vary.from, vary.to, logarithmic, integer};
  if (gives("step") && (vary.to - vary.from) / vary.step > kMostValues)
    return RangeMistake{"step", "the range has more than a million values"};
  if (gives("factor") && std::log(vary.to / vary.from) / std::log(vary.factor) > kMostValues)
    return RangeMistake{"factor", "the range has more than a million values"};
  if (gives("step")) return values_of(by_steps(vary), integer);
  if (gives("factor")) return values_of(by_factors(vary), integer);
  return values_of(by_count(vary), integer);
}

config::Raw value_at(const Span& span, double fraction) {
  if (!span.integer) return raw_of(between(span.from, span.to, span.logarithmic, fraction), false);
  // Every whole number has an equal share of the span.
  const double from = span.logarithmic ? span.from : span.from - 0.5;
  const double to = span.logarithmic ? span.to : span.to + 0.5;
  const double value = std::round(between(from, to, span.logarithmic, fraction));
  return raw_of(std::clamp(value, span.from, span.to), true);
}

}  // namespace rastertlm::explore
