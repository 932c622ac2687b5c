// What one parameter does when it is moved one step from a point, and which such move is best.
//
// A step is src/explore/axis_order.h's. Only what the sweep holds is told: a move that it has no finished point for is
// listed without figures, and no farther value is taken instead.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

enum class MoveState {
  known,     // a point that is done and meets the constraints
  breaks,    // done, but breaks a constraint: listed, never best
  failed,    // its point failed
  waiting,   // its point has not run yet
  not_there  // no point of the sweep is there
};

struct Move {
  std::size_t axis = 0;
  std::size_t value = 0;  // after the move
  MoveState state = MoveState::not_there;
  std::optional<std::size_t> row;  // none: not there
  // An objective each: how much better (above 0) or worse the figure becomes, in the objective's unit whatever its
  // sense; 0 where both are infinite or both missing. None where one of the two is missing, or the move's state is
  // failed, waiting or not there.
  std::vector<std::optional<double>> gains;
};

// How much an objective's figure grows with the move: the gain for what is to be most, the loss for what is to be
// least.
std::optional<double> change_of(const Move& move, std::size_t objective, Sense sense);

// The best moves for one objective: those that make it better by the most; of equal ones the first of the list. None
// where no known move makes it better.
struct BestMoves {
  std::optional<std::size_t> whatever;                     // the other objectives become
  std::optional<std::size_t> no_worse;                     // all other objectives no worse than tolerated
  std::vector<std::optional<std::size_t>> while_no_worse;  // objective each: this one no worse; of itself: `whatever`
};

struct WhatIf {
  std::size_t from = 0;         // row
  std::vector<Move> moves;      // by axis, then as axis_order.h orders steps
  std::vector<BestMoves> best;  // an objective each
};

// "No worse" allows a loss of `tolerance` times the figure's magnitude at the start (0.01: one percent). A figure that
// is lost (missing after the move, not before) is worse. Throws std::invalid_argument where `from` is no row that is
// done, or the tolerance is negative or no number.
WhatIf find_what_if(const SweepTable& table, std::size_t from, double tolerance = 0.0);

}  // namespace rastertlm::explore
