#include "src/explore/sweep_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rastertlm::explore {
namespace {

using report::Align;
using report::Column;

// A name that the sweep gives may not say the unit.
template <typename Figure>
Column figure_column(const Figure& figure, const std::string& name) {
  const bool says = figure.name.empty() || figure.unit.empty() || says_unit(name, figure.unit);
  return {says ? name : fmt::format("{}, {}", name, in_one_line(figure.unit)), Align::right};
}

}  // namespace

bool has_cases(const SweepTable& table) {
  return std::ranges::any_of(table.axes, [](const Axis& axis) { return axis.given; });
}

std::vector<std::size_t> asked_case(const SweepTable& table, const Front& front) {
  if (table.baseline) {
    std::vector<std::size_t> own = case_of(table, table.rows.at(*table.baseline));
    if (std::ranges::any_of(front.rows, [&](std::size_t r) { return case_of(table, table.rows[r]) == own; }))
      return own;
  }
  return front.rows.empty() ? std::vector<std::size_t>{} : case_of(table, table.rows[front.rows.front()]);
}

void sort_by_case(const SweepTable& table, const Front& front, std::vector<std::size_t>& rows) {
  if (!has_cases(table)) return;
  const std::vector<std::size_t> asked = asked_case(table, front);
  const auto key = [&](std::size_t r) {
    const std::vector<std::size_t> own = case_of(table, table.rows[r]);
    return std::pair(own != asked, own);
  };
  std::ranges::stable_sort(rows, [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
}

CaseTables::CaseTables(const SweepTable& table, const Names& names, std::string last)
    : table_(table), names_(names), last_(std::move(last)) {}

void CaseTables::begin(const Row& row) {
  done_ = text();
  case_ = case_of(table_, row);
  if (has_cases(table_))
    done_ += fmt::format("{}{}Given {}:\n", done_.empty() ? "" : "\n", kIndent, case_text(table_, names_, row));
  std::vector<Column> columns{{"point", Align::right}};
  for (std::size_t a = 0; a < table_.axes.size(); ++a)
    if (!table_.axes[a].given) columns.push_back({names_.axes[a], Align::right});
  for (std::size_t o = 0; o < table_.objectives.size(); ++o)
    columns.push_back(figure_column(table_.objectives[o], names_.objectives[o]));
  for (std::size_t k = 0; k < table_.further.size(); ++k)
    columns.push_back(figure_column(table_.further[k], names_.further[k]));
  columns.push_back({last_, Align::right});
  rows_.emplace(std::move(columns), kIndent);
}

void CaseTables::add(const Row& row, std::string last) {
  if (!rows_ || case_of(table_, row) != case_) begin(row);
  std::vector<std::string> cells{std::to_string(row.number)};
  for (std::size_t a = 0; a < table_.axes.size(); ++a)
    if (!table_.axes[a].given) cells.push_back(in_one_line(table_.axes[a].values.at(row.values[a])));
  for (const auto& figure : row.figures) cells.push_back(shown_figure(figure));
  for (const auto& figure : row.further) cells.push_back(shown_figure(figure));
  cells.push_back(std::move(last));
  rows_->row(std::move(cells));
}

std::string CaseTables::text() const { return rows_ ? done_ + rows_->text() : done_; }

}  // namespace rastertlm::explore
