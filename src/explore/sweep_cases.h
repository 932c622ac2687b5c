// Points as tables, one for each case: the values of the axes that are given.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "src/explore/front.h"
#include "src/explore/sweep_table.h"
#include "src/explore/sweep_words.h"
#include "src/report/text_table.h"

namespace rastertlm::explore {

bool has_cases(const SweepTable& table);
// The case that is asked for: the baseline's, else, or where that has no front, that of the front's first point.
std::vector<std::size_t> asked_case(const SweepTable& table, const Front& front);
// Rows of the asked case first, then case by case; those of a case stay in their order.
void sort_by_case(const SweepTable& table, const Front& front, std::vector<std::size_t>& rows);

// Points in the order in which they come: their number, what was chosen, objectives, further figures and a last cell. A
// case has a table of its own, under a line that tells it; rows of one case come one after another.
class CaseTables {
 public:
  CaseTables(const SweepTable& table, const Names& names, std::string last);
  void add(const Row& row, std::string last);
  std::string text() const;

 private:
  void begin(const Row& row);

  const SweepTable& table_;
  const Names& names_;
  std::string last_;
  std::string done_;  // tables before
  std::vector<std::size_t> case_;
  std::optional<report::TextTable> rows_;
};

}  // namespace rastertlm::explore
