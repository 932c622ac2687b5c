// What a statistic is: a figure of the report with its unit, and where it comes from.
#pragma once

#include <string>

namespace rastertlm::parameter {

enum class StatisticKind { count, formula, setting };

enum class StatisticValue { number, truth, text, table };

struct Statistic {
  std::string name;  // path in report.json: "links[].utilisation"
  std::string unit;  // "" where it has none
  StatisticKind kind = StatisticKind::count;
  std::string description;  // one sentence; a formula says its formula
  StatisticValue value = StatisticValue::number;
};

}  // namespace rastertlm::parameter
