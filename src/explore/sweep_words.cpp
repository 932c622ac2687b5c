#include "src/explore/sweep_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/report/number_text.h"

namespace rastertlm::explore {
namespace {

// Where the path's parts begin, the last first. A point within brackets parts nothing: "sum(memories[].words)" is one.
std::vector<std::size_t> part_starts(const std::string& path) {
  std::vector<std::size_t> starts;
  int depth = 0;
  bool bracket_in_part = false;
  for (std::size_t i = path.size(); i-- > 0;) {
    if (path[i] == ']' || path[i] == ')') ++depth;
    if (path[i] == '[' || path[i] == '(') {
      --depth;
      bracket_in_part = true;
    }
    if (path[i] != '.' || depth != 0) continue;
    // What stands in brackets names the thing, what follows it only says which figure of it: they stay together.
    if (!starts.empty() || bracket_in_part || i == 0 || path[i - 1] != ']') starts.push_back(i + 1);
    bracket_in_part = false;
  }
  starts.push_back(0);
  return starts;
}

bool is_ending(const std::string& path, const std::string& ending) {
  return path.ends_with(ending) && (path.size() == ending.size() || path[path.size() - ending.size() - 1] == '.');
}

}  // namespace

std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  names.reserve(paths.size());
  for (const std::string& path : paths) {
    std::string name = path;
    for (const std::size_t start : part_starts(path)) {
      name = path.substr(start);
      if (std::ranges::count_if(paths, [&](const std::string& other) { return is_ending(other, name); }) <= 1) break;
    }
    names.push_back(std::move(name));
  }
  return names;
}

Names::Names(const SweepTable& table) {
  std::vector<std::string> paths;
  for (const Axis& axis : table.axes) paths.push_back(axis.path);
  for (const Objective& objective : table.objectives) paths.push_back(objective.path);
  const std::vector<std::string> names = short_names(paths);
  const auto middle = names.begin() + static_cast<std::ptrdiff_t>(table.axes.size());
  axes.assign(names.begin(), middle);
  objectives.assign(middle, names.end());
}

std::string heading(const std::string& title) {
  return fmt::format("\n{}\n{}\n", title, std::string(title.size(), '='));
}

std::string in_one_line(const std::string& text) {
  std::string line = text;
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return line;
}

std::string unit_text(const std::string& unit) {
  return unit.empty() || unit == "fraction" ? "" : ' ' + in_one_line(unit);
}

std::string shown_figure(const std::optional<double>& figure) {
  if (!figure || std::isnan(*figure)) return "-";
  if (std::isinf(*figure)) return *figure > 0.0 ? "infinite" : "-infinite";
  return report::quantity(*figure);
}

std::string change_text(double change) { return fmt::format("{}{}", change > 0.0 ? "+" : "", shown_figure(change)); }

std::string change_text(double change, const std::optional<double>& before, const std::string& unit) {
  std::string text = change_text(change) + unit_text(unit);
  if (change == 0.0 || !before || *before == 0.0 || !std::isfinite(*before) || !std::isfinite(change)) return text;
  const double part = change / std::abs(*before);
  return fmt::format("{} ({}{})", text, part > 0.0 ? "+" : "", report::percent(part));
}

std::string point_text(const SweepTable& table, const Names& names, const Row& row) {
  std::string text;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    if (a > 0) text += ", ";
    text += names.axes[a] + " = " + in_one_line(table.axes[a].values.at(row.values[a]));
    text += unit_text(table.axes[a].unit);
  }
  return text;
}

const char* wanted_text(Sense sense) { return sense == Sense::minimise ? "least" : "most"; }

std::string csv_figure(const std::optional<double>& figure) {
  if (!figure || std::isnan(*figure)) return "";
  return fmt::format("{:.9g}", *figure);
}

}  // namespace rastertlm::explore
