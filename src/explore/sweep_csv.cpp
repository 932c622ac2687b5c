#include "src/explore/sweep_csv.h"

#include <fmt/format.h>

#include "src/explore/sweep_words.h"
#include "src/explore/table_text.h"

namespace rastertlm::explore {
namespace {

const char* name_of(Effects effects) {
  switch (effects) {
    case Effects::by_value:
      return "by_value";
    case Effects::by_line:
      return "by_line";
    case Effects::undetermined:
      break;
  }
  return "undetermined";
}

const char* name_of(MoveState state) {
  switch (state) {
    case MoveState::known:
      return "known";
    case MoveState::breaks:
      return "breaks a constraint";
    case MoveState::failed:
      return "failed";
    case MoveState::waiting:
      return "waiting";
    case MoveState::not_there:
      break;
  }
  return "not in the sweep";
}

}  // namespace

std::string sensitivity_csv(const SweepTable& table, const std::vector<ObjectiveSensitivity>& sensitivity) {
  std::string text = "objective,unit,parameter,value,points,effects,difference,reference,share\n";
  for (std::size_t o = 0; o < sensitivity.size(); ++o) {
    for (const Sensitivity& s : sensitivity[o].axes) {
      const Axis& axis = table.axes[s.axis];
      for (std::size_t v = 0; v < axis.values.size(); ++v)
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(table.objectives[o].path),
                            csv_cell(table.objectives[o].unit), csv_cell(axis.path), csv_cell(axis.values[v]),
                            s.points[v], name_of(s.effects), csv_figure(s.differences[v]),
                            csv_cell(axis.values[s.reference]), csv_figure(s.share));
    }
  }
  return text;
}

std::string what_if_csv(const SweepTable& table, const WhatIf& what_if) {
  std::string text = "parameter,from,to,state,point";
  for (const Objective& objective : table.objectives) text += ',' + csv_cell(objective.path);
  text += '\n';
  const Row& start = table.rows[what_if.from];
  for (const Move& move : what_if.moves) {
    const Axis& axis = table.axes[move.axis];
    text += fmt::format("{},{},{},{},{}", csv_cell(axis.path), csv_cell(axis.values[start.values[move.axis]]),
                        csv_cell(axis.values[move.value]), name_of(move.state),
                        move.row ? std::to_string(table.rows[*move.row].number) : "");
    for (std::size_t o = 0; o < table.objectives.size(); ++o)
      text += ',' + csv_figure(change_of(move, o, table.objectives[o].sense));
    text += '\n';
  }
  return text;
}

}  // namespace rastertlm::explore
