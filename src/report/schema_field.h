// What a key of report.json says of itself.
#pragma once

#include "src/parameter/statistic.h"

namespace rastertlm::report {

struct Field {
  const char* unit;
  parameter::StatisticKind kind;
  const char* description;
};

namespace schema {

inline constexpr auto kCount = parameter::StatisticKind::count;
inline constexpr auto kFormula = parameter::StatisticKind::formula;
inline constexpr auto kSetting = parameter::StatisticKind::setting;

}  // namespace schema
}  // namespace rastertlm::report
