#include "src/report/merged_rows.h"

#include <gtest/gtest.h>

#include <string>

namespace rastertlm::report {
namespace {

using Rows = std::vector<std::vector<std::string>>;

TEST(MergedRows, JoinsNeighboursThatDifferInTheirNumberOnly) {
  const Rows rows{{"host", "1"},          {"unit 0", "5"},        {"unit 1", "5"}, {"unit 2", "6"},
                  {"unit 3", "5"},        {"unit 5", "5"},        {"bus 6", "5"},  {"board 9 to x", "1"},
                  {"board 10 to x", "1"}, {"board 11 to y", "1"}, {"video", "1"}};
  EXPECT_EQ(merged_rows(rows), (Rows{{"host", "1"},
                                     {"unit 0-1", "5"},
                                     {"unit 2", "6"},
                                     {"unit 3", "5"},
                                     {"unit 5", "5"},
                                     {"bus 6", "5"},
                                     {"board 9-10 to x", "1"},
                                     {"board 11 to y", "1"},
                                     {"video", "1"}}));
}

TEST(MergedRows, DoesNotJoinNamesWithoutANumber) {
  const Rows rows{{"a", "1"}, {"a", "1"}};
  EXPECT_EQ(merged_rows(rows), rows);
}

// n units with figures of their own.
Rows units(std::size_t n) {
  Rows rows;
  for (std::size_t i = 0; i < n; ++i) rows.push_back({"unit " + std::to_string(i), std::to_string(10 * i), "x"});
  return rows;
}

TEST(MergedRows, ShowsSixteenOfAKindAndCountsTheRest) {
  EXPECT_EQ(merged_rows(units(17)), units(17)) << "a row that says \"1 more\" saves none";
  Rows rows = units(40);
  rows.push_back({"unit 40", "390", "x"});  // joins the last: rows stand for more than one
  rows.push_back({"video", "1", "x"});
  const Rows merged = merged_rows(rows);
  ASSERT_EQ(merged.size(), 18U);
  EXPECT_EQ(merged[15][0], "unit 15");
  EXPECT_EQ(merged[16], (std::vector<std::string>{"... 25 more, in report.json", "", ""}));
  EXPECT_EQ(merged[17][0], "video");
}

}  // namespace
}  // namespace rastertlm::report
