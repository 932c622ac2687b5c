// Tables for tests, without a simulation.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

using Figures = std::vector<std::optional<double>>;

inline Axis axis_of(std::string path, std::vector<std::string> values) {
  return {std::move(path), "", std::move(values)};
}

inline Axis numbered_axis(std::string path, std::size_t values) {
  Axis axis{std::move(path), "", {}};
  for (std::size_t v = 0; v < values; ++v) axis.values.push_back(std::to_string(v + 1));
  return axis;
}

inline Objective objective_of(std::string path, Sense sense) { return {std::move(path), "", sense}; }

inline Row& add_row(SweepTable& table, std::vector<std::size_t> values, Figures figures, State state = State::done,
                    bool allowed = true) {
  Row row;
  row.number = table.rows.size();
  row.values = std::move(values);
  row.figures = std::move(figures);
  row.state = state;
  row.allowed = allowed;
  if (state == State::failed) row.error = "it failed";
  table.rows.push_back(std::move(row));
  return table.rows.back();
}

// Every combination of the axes' values, the last axis fastest, with figures by a function of the values.
template <typename Function>
void add_grid(SweepTable& table, const Function& figures) {
  std::vector<std::size_t> values(table.axes.size(), 0);
  for (;;) {
    add_row(table, values, figures(values));
    std::size_t a = values.size();
    while (a > 0 && values[a - 1] + 1 == table.axes[a - 1].values.size()) values[--a] = 0;
    if (a == 0) return;
    ++values[a - 1];
  }
}

}  // namespace rastertlm::explore
