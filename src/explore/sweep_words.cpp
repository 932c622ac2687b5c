#include "src/explore/sweep_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "src/report/number_text.h"

namespace rastertlm::explore {
namespace {

// Names that a path may have, the shortest first, the path itself last.
std::vector<std::string> candidates(const std::string& path) {
  std::vector<std::string> names;
  const std::size_t open = path.find('(');
  if (open != std::string::npos && path.back() == ')' && open < path.find('[')) {
    for (const std::string& inner : candidates(path.substr(open + 1, path.size() - open - 2)))
      names.push_back(path.substr(0, open) + ' ' + inner);
    names.push_back(path);
    return names;
  }
  int depth = 0;
  for (std::size_t i = path.size(); i-- > 0;) {
    if (path[i] == ']') ++depth;
    if (path[i] == '[') --depth;
    if (path[i] != '.' || depth != 0) continue;
    const std::string ending = path.substr(i + 1);
    // What follows "budgets[line_start]" says which figure of it, and is none without its name.
    const std::size_t bracket = path[i - 1] == ']' ? path.rfind('[', i) : std::string::npos;
    const std::string element = bracket == std::string::npos ? "" : path.substr(bracket + 1, i - bracket - 2);
    const bool named = element.find_first_not_of("0123456789") != std::string::npos;
    names.push_back(named ? fmt::format("{} {}", element, ending) : ending);
  }
  names.push_back(path);
  return names;
}

template <typename Wanted>
std::string values_text(const SweepTable& table, const Names& names, const Row& row, const Wanted& wanted) {
  std::string text;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    if (!wanted(table.axes[a])) continue;
    if (!text.empty()) text += ", ";
    text += names.axes[a] + " = " + in_one_line(table.axes[a].values.at(row.values[a]));
    text += unit_text(table.axes[a].unit, names.axes[a]);
  }
  return text;
}

}  // namespace

std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<std::vector<std::string>> possible;
  std::map<std::string, std::size_t> claimed;  // by how many paths
  for (const std::string& path : paths) {
    possible.push_back(candidates(path));
    for (const std::string& name : possible.back()) ++claimed[name];
  }
  std::vector<std::string> names;
  names.reserve(paths.size());
  for (const std::vector<std::string>& own : possible) {
    const auto alone = std::ranges::find_if(own, [&](const std::string& name) { return claimed[name] == 1; });
    names.push_back(alone == own.end() ? own.back() : *alone);
  }
  return names;
}

Names::Names(const SweepTable& table) {
  std::vector<std::string> paths;
  for (const Axis& axis : table.axes) paths.push_back(axis.path);
  for (const Objective& objective : table.objectives) paths.push_back(objective.path);
  for (const FurtherFigure& one : table.further) paths.push_back(one.path);
  const std::vector<std::string> names = short_names(paths);
  auto next = names.begin();
  for (std::size_t a = 0; a < table.axes.size(); ++a) axes.push_back(*next++);
  const auto name = [&](const std::string& given) {
    const std::string& made = *next++;
    return in_one_line(given.empty() ? made : given);
  };
  for (const Objective& one : table.objectives) objectives.push_back(name(one.name));
  for (const FurtherFigure& one : table.further) further.push_back(name(one.name));
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

bool says_unit(const std::string& name, const std::string& unit) {
  const auto is_letter = [&](std::size_t i) {
    return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i])) != 0;
  };
  for (std::size_t at = name.find(unit); at != std::string::npos; at = name.find(unit, at + 1))
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + unit.size())) return true;
  return false;
}

std::string unit_text(const std::string& unit, const std::string& name) {
  return unit.empty() || unit == "fraction" || says_unit(name, unit) ? "" : ' ' + in_one_line(unit);
}

std::string shown_figure(const std::optional<double>& figure) {
  if (!figure || std::isnan(*figure)) return "-";
  if (std::isinf(*figure)) return *figure > 0.0 ? "infinite" : "-infinite";
  return report::quantity(*figure);
}

std::string change_text(double change) { return fmt::format("{}{}", change > 0.0 ? "+" : "", shown_figure(change)); }

std::string change_text(double change, const std::optional<double>& before, const std::string& unit) {
  std::string text = change_text(change) + unit;
  if (change == 0.0 || !before || *before == 0.0 || !std::isfinite(*before) || !std::isfinite(change)) return text;
  const double part = change / std::abs(*before);
  return fmt::format("{} ({}{})", text, part > 0.0 ? "+" : "", report::percent(part));
}

std::string point_text(const SweepTable& table, const Names& names, const Row& row) {
  return values_text(table, names, row, [](const Axis&) { return true; });
}
std::string case_text(const SweepTable& table, const Names& names, const Row& row) {
  return values_text(table, names, row, [](const Axis& axis) { return axis.given; });
}
std::string choice_text(const SweepTable& table, const Names& names, const Row& row) {
  return values_text(table, names, row, [](const Axis& axis) { return !axis.given; });
}

const char* wanted_text(Sense sense) { return sense == Sense::minimise ? "least" : "most"; }

std::string csv_figure(const std::optional<double>& figure) {
  if (!figure || std::isnan(*figure)) return "";
  return fmt::format("{:.9g}", *figure);
}

}  // namespace rastertlm::explore
