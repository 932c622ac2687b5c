// How a sweep's points, parameters and figures are called in text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

// What stands in a table for each path: its shortest ending, of whole parts, that no other could have:
//   answer.frame_rate_hz              frame_rate_hz
//   budgets[line_start].used          line_start used
//   max(images[].error.rmse_level)    max rmse_level
std::vector<std::string> short_names(const std::vector<std::string>& paths);

// The short names of a table's axes, objectives and further figures, found together; or those that the sweep gives
// them.
struct Names {
  explicit Names(const SweepTable& table);
  std::vector<std::string> axes;
  std::vector<std::string> objectives;
  std::vector<std::string> further;
};

inline constexpr const char* kIndent = "  ";  // of what stands under a heading
// An empty line, the title, and a line under it.
std::string heading(const std::string& title);

// One line, whatever the text holds.
std::string in_one_line(const std::string& text);
// Whether the name has the unit among its words, which anything but letters divides: "set_up_us" has us, "bus" has not.
bool says_unit(const std::string& name, const std::string& unit);
// " Hz", what stands behind a figure of that name; empty where there is none, where the name says it, and for a
// fraction.
std::string unit_text(const std::string& unit, const std::string& name);
// 333,333, 0.5094, infinite; "-" where there is none.
std::string shown_figure(const std::optional<double>& figure);
// With its sign: "+20"; "0" for none.
std::string change_text(double change);
// The same, its unit_text() where one is given, and what part of the figure before it is where that says anything:
// "+20 Hz (+67 %)".
std::string change_text(double change, const std::optional<double>& before, const std::string& unit = "");
// "computation_units = 8, topology = "tree"".
std::string point_text(const SweepTable& table, const Names& names, const Row& row);
// The same of the axes that are given, and of those that are not.
std::string case_text(const SweepTable& table, const Names& names, const Row& row);
std::string choice_text(const SweepTable& table, const Names& names, const Row& row);
// "least" or "most".
const char* wanted_text(Sense sense);

// Nine significant digits; empty where there is none.
std::string csv_figure(const std::optional<double>& figure);

}  // namespace rastertlm::explore
