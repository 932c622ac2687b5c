#include "src/explore/table_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::explore {
namespace {

using report::Align;
using report::Column;
using report::TextTable;

constexpr std::size_t kMostErrors = 10;

const char* state_text(const Row& row) {
  if (row.state == State::waiting) return "waiting";
  if (row.state == State::failed) return "failed";
  return row.allowed ? "done" : "not allowed";
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::size_t count(const SweepTable& table, State state) {
  return static_cast<std::size_t>(
      std::count_if(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row.state == state; }));
}

std::string counts_text(const SweepTable& table) {
  using report::counted;
  const auto allowed = static_cast<std::size_t>(
      std::count_if(table.rows.begin(), table.rows.end(), [](const Row& row) { return row.allowed; }));
  std::string text = fmt::format("{}: {} done, {} failed, {} waiting", counted(table.rows.size(), "point", "points"),
                                 count(table, State::done), count(table, State::failed), count(table, State::waiting));
  if (!table.constraints.empty()) {
    text += fmt::format("; {} meet", allowed);
    for (const std::string& one : table.constraints)
      text += fmt::format("{} {}", &one == &table.constraints.front() ? "" : ",", one);
  }
  return text + '\n';
}

// The first line of an error says what is wrong.
std::string errors_text(const SweepTable& table) {
  std::string text;
  std::size_t said = 0;
  for (const Row& row : table.rows) {
    if (row.state != State::failed || said++ >= kMostErrors) continue;
    text += fmt::format("point {} failed: {}\n", row.number, row.error.substr(0, row.error.find('\n')));
  }
  if (said > kMostErrors) text += fmt::format("and {} more\n", said - kMostErrors);
  return text;
}

std::string without_breaks(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string figure_text(const std::optional<double>& figure) { return figure ? fmt::format("{:.6g}", *figure) : "-"; }

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

std::string table_text(const SweepTable& table, std::size_t most_rows) {
  std::string text = table.name + '\n';
  if (!table.question.empty()) text += table.question + '\n';
  text += counts_text(table) + '\n';
  std::vector<Column> columns{{"point", Align::right}};
  for (const Axis& axis : table.axes) columns.push_back({with_unit(axis.path, axis.unit), Align::left});
  for (const Objective& objective : table.objectives)
    columns.push_back({with_unit(objective.path, objective.unit), Align::right});
  for (const FurtherFigure& one : table.further) columns.push_back({with_unit(one.path, one.unit), Align::right});
  columns.push_back({"state", Align::left});
  TextTable rows(columns);
  for (std::size_t i = 0; i < std::min(most_rows, table.rows.size()); ++i) {
    const Row& row = table.rows[i];
    const bool is_baseline = table.baseline && *table.baseline == i;
    std::vector<std::string> cells{fmt::format("{}{}", row.number, is_baseline ? "*" : "")};
    for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
      cells.push_back(table.axes[axis].values.at(row.values.at(axis)));
    for (const std::optional<double>& figure : row.figures) cells.push_back(figure_text(figure));
    for (const std::optional<double>& figure : row.further) cells.push_back(figure_text(figure));
    cells.emplace_back(state_text(row));
    rows.row(std::move(cells));
  }
  text += rows.text();
  if (table.baseline) text += "* the baseline\n";
  if (table.rows.size() > most_rows)
    text += fmt::format("{} more points; --rows says how many are listed, --csv lists all\n",
                        table.rows.size() - most_rows);
  return text + errors_text(table);
}

std::string table_csv(const SweepTable& table, const Front& front) {
  std::string text = "point,state,allowed,baseline,front,beaten_by";
  for (const Axis& axis : table.axes) text += ',' + csv_cell(with_unit(axis.path, axis.unit));
  for (const Objective& objective : table.objectives) text += ',' + csv_cell(with_unit(objective.path, objective.unit));
  for (const FurtherFigure& one : table.further) text += ',' + csv_cell(with_unit(one.path, one.unit));
  text += ",config_digest,scene_digest,error\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Row& row = table.rows[i];
    const char* state = row.state == State::done ? "done" : row.state == State::failed ? "failed" : "waiting";
    text += fmt::format("{},{},{},{}", row.number, state, row.allowed ? 1 : 0,
                        table.baseline && *table.baseline == i ? 1 : 0);
    text += !front.compared[i] ? "," : front.has(i) ? ",1" : ",0";
    text += front.beaten_by[i] ? fmt::format(",{}", table.rows[*front.beaten_by[i]].number) : std::string(",");
    for (std::size_t axis = 0; axis < table.axes.size(); ++axis)
      text += ',' + csv_cell(table.axes[axis].values.at(row.values.at(axis)));
    for (const auto* figures : {&row.figures, &row.further})
      for (const std::optional<double>& figure : *figures)
        text += figure ? fmt::format(",{:.9g}", *figure) : std::string(",");
    text += fmt::format(",{},{},{}\n", row.config_digest, row.scene_digest, csv_cell(without_breaks(row.error)));
  }
  return text;
}

}  // namespace rastertlm::explore
