#include "src/explore/what_if.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "src/explore/axis_order.h"
#include "src/explore/front.h"

namespace rastertlm::explore {
namespace {

using Figure = std::optional<double>;

bool is_missing(const Figure& figure) { return !figure || std::isnan(*figure); }

Figure gain_of(const Figure& before, const Figure& after, Sense sense) {
  if (compare_figures(before, after, sense) == 0) return 0.0;
  if (is_missing(before) || is_missing(after)) return {};
  return sense == Sense::maximise ? *after - *before : *before - *after;
}

MoveState state_of(const Row& row) {
  if (row.state == State::failed) return MoveState::failed;
  if (row.state == State::waiting) return MoveState::waiting;
  return row.allowed ? MoveState::known : MoveState::breaks;
}

// The axis in which alone two points differ.
std::optional<std::size_t> only_difference(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  std::optional<std::size_t> axis;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    if (axis) return {};
    axis = i;
  }
  return axis;
}

std::vector<Move> find_moves(const SweepTable& table, const Row& start) {
  std::vector<Move> moves;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    if (table.axes[a].given) continue;
    for (const std::size_t value : one_step_from(table.axes[a], start.values[a]))
      moves.push_back({a, value, MoveState::not_there, {}, std::vector<Figure>(table.objectives.size())});
  }
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const Row& row = table.rows[r];
    const auto axis = only_difference(start.values, row.values);
    if (!axis) continue;
    const auto move = std::ranges::find_if(
        moves, [&](const Move& m) { return m.axis == *axis && m.value == row.values[*axis] && !m.row; });
    if (move == moves.end()) continue;
    move->row = r;
    move->state = state_of(row);
    if (row.state != State::done) continue;
    for (std::size_t o = 0; o < table.objectives.size(); ++o)
      move->gains[o] = gain_of(start.figures[o], row.figures[o], table.objectives[o].sense);
  }
  return moves;
}

// What a move may lose of an objective, and whether it keeps to that.
class Limits {
 public:
  Limits(const SweepTable& table, const Row& start, double tolerance)
      : table_(table), start_(start), tolerance_(tolerance) {}

  bool keeps(const Move& move, std::size_t objective) const {
    const Figure& before = start_.figures[objective];
    const Figure& after = table_.rows[*move.row].figures[objective];
    if (compare_figures(after, before, table_.objectives[objective].sense) <= 0) return true;
    const Figure& gain = move.gains[objective];
    return gain && std::isfinite(*gain) && *gain >= -tolerance_ * std::abs(*before);
  }

 private:
  const SweepTable& table_;
  const Row& start_;
  double tolerance_;
};

template <typename Allowed>
std::optional<std::size_t> best_of(const std::vector<Move>& moves, std::size_t objective, const Allowed& allowed) {
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t m = 0; m < moves.size(); ++m) {
    if (moves[m].state != MoveState::known) continue;
    const Figure& gain = moves[m].gains[objective];
    if (!gain || *gain <= most || !allowed(moves[m])) continue;
    most = *gain;
    best = m;
  }
  return best;
}

}  // namespace

std::optional<double> change_of(const Move& move, std::size_t objective, Sense sense) {
  const Figure& gain = move.gains[objective];
  if (!gain || *gain == 0.0) return gain;  // 0 and never -0
  return sense == Sense::maximise ? *gain : -*gain;
}

WhatIf find_what_if(const SweepTable& table, std::size_t from, double tolerance) {
  if (from >= table.rows.size()) throw std::invalid_argument("row " + std::to_string(from) + " is not in the table");
  const Row& start = table.rows[from];
  if (start.state != State::done)
    throw std::invalid_argument("point " + std::to_string(start.number) + " has no figures: it is not done");
  if (!(tolerance >= 0.0)) throw std::invalid_argument("a tolerance must not be negative");

  WhatIf result;
  result.from = from;
  result.moves = find_moves(table, start);
  const Limits limits(table, start, tolerance);
  const std::size_t objectives = table.objectives.size();
  for (std::size_t o = 0; o < objectives; ++o) {
    BestMoves best;
    best.whatever = best_of(result.moves, o, [](const Move&) { return true; });
    best.no_worse = best_of(result.moves, o, [&](const Move& move) {
      for (std::size_t other = 0; other < objectives; ++other)
        if (other != o && !limits.keeps(move, other)) return false;
      return true;
    });
    for (std::size_t held = 0; held < objectives; ++held)
      best.while_no_worse.push_back(
          best_of(result.moves, o, [&](const Move& move) { return held == o || limits.keeps(move, held); }));
    result.best.push_back(std::move(best));
  }
  return result;
}

}  // namespace rastertlm::explore
