// The sections of sweep_text.h that tell what parameters do.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/explore/sweep_text.h"
#include "src/explore/sweep_words.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"

namespace rastertlm::explore {
namespace {

using report::Align;
using report::Column;
using report::counted;
using report::grouped;
using report::percent;
using report::TextTable;

// Of the span: below it a mean is where the figure happens to cancel, and a part of it says nothing.
constexpr double kLeastMean = 0.1;

std::string value_text(const SweepTable& table, std::size_t axis, std::size_t value) {
  return in_one_line(table.axes[axis].values.at(value));
}

std::string estimator_sentence(const ObjectiveSensitivity& s) {
  std::string text;
  switch (s.design) {
    case DesignKind::grid:
      text = s.axes.size() == 1 ? fmt::format("differences between its {}", counted(s.points, "point", "points"))
                                : fmt::format("differences of means over all other parameters ({} points, a full grid)",
                                              grouped(s.points));
      break;
    case DesignKind::one_at_a_time:
      text = fmt::format("differences from the baseline, one parameter at a time ({} points)", grouped(s.points));
      break;
    case DesignKind::scattered:
      text = fmt::format("least-squares fit of {} to {}", counted(s.unknowns, "effect", "independent effects"),
                         counted(s.points, "point", "points"));
      break;
  }
  if (s.infinite > 0) text += fmt::format("; {} with an infinite figure left out", grouped(s.infinite));
  if (s.unexplained && *s.unexplained < 1e-9) text += "; they explain all of its variance";
  if (s.unexplained && *s.unexplained >= 1e-9)
    text += fmt::format("; they leave {} of its variance unexplained", percent(*s.unexplained));
  return text;
}

std::vector<std::string> effect_cells(const SweepTable& table, const std::string& name, const Sensitivity& s,
                                      double mean) {
  std::string note;
  if (s.effects == Effects::by_line) note = "a straight line";
  if (s.effects == Effects::undetermined) {
    const auto values = std::ranges::count_if(s.points, [](std::uint64_t n) { return n > 0; });
    note = values < 2 ? "has one value there" : "left open by these points";
  }
  if (!s.span) return {name, "-", "", "", "", "", note};
  const bool still = *s.span <= 1e-9 * std::abs(mean);
  return {name,
          shown_figure(still ? 0.0 : *s.span),
          std::abs(mean) >= kLeastMean * *s.span && !still ? percent(*s.span / std::abs(mean)) : "",
          still ? "" : value_text(table, s.axis, s.least_at),
          still ? "" : value_text(table, s.axis, s.most_at),
          s.share && !still ? percent(*s.share) : "",
          note};
}

const char* note_of(MoveState state) {
  switch (state) {
    case MoveState::known:
      return "";
    case MoveState::breaks:
      return "breaks a constraint";
    case MoveState::failed:
      return "its point failed";
    case MoveState::waiting:
      return "its point has not run";
    case MoveState::not_there:
      break;
  }
  return "no point of the sweep";
}

std::string move_text(const SweepTable& table, const Names& names, const WhatIf& what_if, const Move& move) {
  return fmt::format("{} {} -> {}", names.axes[move.axis],
                     value_text(table, move.axis, table.rows[what_if.from].values[move.axis]),
                     value_text(table, move.axis, move.value));
}

std::string change_cell(const SweepTable& table, const WhatIf& what_if, const Move& move, std::size_t objective) {
  const auto change = change_of(move, objective, table.objectives[objective].sense);
  return change ? change_text(*change, table.rows[what_if.from].figures[objective]) : "-";
}

std::string moves_table(const SweepTable& table, const Names& names, const WhatIf& what_if) {
  std::vector<Column> columns{{"parameter"}, {"from", Align::right}, {"to", Align::right}, {"point", Align::right}};
  for (const std::string& name : names.objectives) columns.push_back({name, Align::right});
  columns.push_back({""});
  TextTable rows(std::move(columns), kIndent);
  for (const Move& move : what_if.moves) {
    std::vector<std::string> cells{
        names.axes[move.axis], value_text(table, move.axis, table.rows[what_if.from].values[move.axis]),
        value_text(table, move.axis, move.value), move.row ? std::to_string(table.rows[*move.row].number) : "-"};
    for (std::size_t o = 0; o < table.objectives.size(); ++o) cells.push_back(change_cell(table, what_if, move, o));
    cells.emplace_back(note_of(move.state));
    rows.row(std::move(cells));
  }
  return rows.text();
}

// A row for each objective and condition on the others; conditions that the best move meets anyhow have none.
std::string best_table(const SweepTable& table, const Names& names, const WhatIf& what_if) {
  std::vector<Column> columns{{"wanted"}, {"where"}, {"best move"}};
  for (const std::string& name : names.objectives) columns.push_back({name, Align::right});
  TextTable rows(std::move(columns), kIndent);
  const std::size_t objectives = table.objectives.size();
  for (std::size_t o = 0; o < objectives; ++o) {
    const BestMoves& best = what_if.best[o];
    const bool free = best.no_worse == best.whatever;  // of charge
    std::vector<std::pair<std::string, std::optional<std::size_t>>> conditions{
        {free && best.whatever ? "no other worse" : "whatever the others do", best.whatever}};
    for (std::size_t held = 0; !free && held < objectives; ++held)
      if (best.while_no_worse[held] != best.whatever)
        conditions.emplace_back(names.objectives[held] + " no worse", best.while_no_worse[held]);
    if (!free && objectives > 2) conditions.emplace_back("no other worse", best.no_worse);
    for (const auto& [condition, move] : conditions) {
      std::vector<std::string> cells{fmt::format("{} {}", wanted_text(table.objectives[o].sense), names.objectives[o]),
                                     condition, "none"};
      if (move) cells.back() = move_text(table, names, what_if, what_if.moves[*move]);
      for (std::size_t other = 0; other < objectives; ++other)
        cells.push_back(move ? change_cell(table, what_if, what_if.moves[*move], other) : "");
      rows.row(std::move(cells));
    }
  }
  return rows.text();
}

}  // namespace

std::string sensitivity_section(const SweepTable& table, const std::vector<ObjectiveSensitivity>& sensitivity) {
  if (table.axes.empty() || sensitivity.empty()) return "";
  const Names names(table);
  std::string text = heading("How far parameters move the objectives");
  for (std::size_t o = 0; o < sensitivity.size(); ++o) {
    const ObjectiveSensitivity& s = sensitivity[o];
    const Objective& objective = table.objectives[o];
    if (o > 0) text += '\n';
    if (s.points == 0) {
      text += fmt::format("{}{}: no point has it.\n", kIndent, names.objectives[o]);
      continue;
    }
    text += fmt::format("{}{}{}: {}\n", kIndent, names.objectives[o],
                        objective.unit.empty() ? "" : ", " + in_one_line(objective.unit), estimator_sentence(s));
    TextTable rows({{"parameter"},
                    {"moves it by", Align::right},
                    {"of its mean", Align::right},
                    {"least at", Align::right},
                    {"most at", Align::right},
                    {"of its variance", Align::right},
                    {""}},
                   kIndent);
    std::vector<const Sensitivity*> order;
    for (const Sensitivity& axis : s.axes) order.push_back(&axis);
    std::ranges::stable_sort(order, [](const Sensitivity* a, const Sensitivity* b) {
      return a->span.value_or(-1.0) > b->span.value_or(-1.0);
    });
    for (const Sensitivity* axis : order) rows.row(effect_cells(table, names.axes[axis->axis], *axis, s.mean));
    text += rows.text();
  }
  return text;
}

std::string what_if_section(const SweepTable& table, const WhatIf& what_if, double tolerance) {
  if (table.axes.empty() || table.objectives.empty()) return "";
  const Names names(table);
  const Row& start = table.rows[what_if.from];
  std::string text = heading(fmt::format("One parameter moved one step from point {}", start.number)) + kIndent +
                     point_text(table, names, start) + ":";
  for (std::size_t o = 0; o < table.objectives.size(); ++o) {
    text += fmt::format("{} {} {}{}", o == 0 ? "" : ",", names.objectives[o], shown_figure(start.figures[o]),
                        unit_text(table.objectives[o].unit, names.objectives[o]));
  }
  text += '\n';
  const bool any = std::ranges::any_of(what_if.moves, [](const Move& move) { return move.row.has_value(); });
  if (!any) return text + kIndent + "No point of this sweep is one step from it.\n";
  text += moves_table(table, names, what_if) + '\n' + best_table(table, names, what_if);
  if (tolerance > 0.0) text += fmt::format("{}No worse: by no more than {}.\n", kIndent, percent(tolerance));
  return text;
}

}  // namespace rastertlm::explore
