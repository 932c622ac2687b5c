// What is said of a key of report.json.
#pragma once

#include <string>

#include "src/parameter/statistic.h"

namespace rastertlm::report {

struct Field {
  const char* unit;
  parameter::StatisticKind kind;
  const char* description;
  bool later{};  // reports of schema 1 had it not from the start: where it is missing, it has its default
};

namespace schema {

inline constexpr auto kCount = parameter::StatisticKind::count;
inline constexpr auto kFormula = parameter::StatisticKind::formula;
inline constexpr auto kSetting = parameter::StatisticKind::setting;
inline constexpr bool kLater = true;

// Of which kinds of machine a section speaks: of both where only described.
struct Kinds {
  bool boards = true;      // object processors
  bool spans = true;       // a span unit
  bool highlights = true;  // looked for before drawing
  explicit Kinds(const std::string& platform)
      : boards(platform.empty() || platform == "imogene"),
        spans(platform != "imogene"),
        highlights(platform.empty() || platform == "adaptive") {}
};

}  // namespace schema
}  // namespace rastertlm::report
