// How a sweep's points, parameters and figures are called in text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

// Paths without what they share: the shortest ending, of whole parts, that no other of them has. A part in brackets
// keeps its name before it: "budgets[line_start].used" never becomes "used".
std::vector<std::string> short_names(const std::vector<std::string>& paths);

// The short names of a table's axes and objectives, found together.
struct Names {
  explicit Names(const SweepTable& table);
  std::vector<std::string> axes;
  std::vector<std::string> objectives;
};

inline constexpr const char* kIndent = "  ";  // of what stands under a heading
// An empty line, the title, and a line under it.
std::string heading(const std::string& title);

// One line, whatever the text holds.
std::string in_one_line(const std::string& text);
// " Hz", what stands behind a figure; empty where there is none, and for a fraction.
std::string unit_text(const std::string& unit);
// 333,333, 0.5094, infinite; "-" where there is none.
std::string shown_figure(const std::optional<double>& figure);
// With its sign: "+20"; "0" for none.
std::string change_text(double change);
// The same, its unit where one is given, and what part of the figure before it is where that says anything:
// "+20 Hz (+67 %)".
std::string change_text(double change, const std::optional<double>& before, const std::string& unit = "");
// "computation_units = 8, topology = "tree"".
std::string point_text(const SweepTable& table, const Names& names, const Row& row);
// "least" or "most".
const char* wanted_text(Sense sense);

// Nine significant digits; empty where there is none.
std::string csv_figure(const std::optional<double>& figure);

}  // namespace rastertlm::explore
