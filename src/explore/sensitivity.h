// How far each objective moves with each parameter.
//
// The estimator is one for all designs: the least-squares fit of
//     figure = mean + an effect of each axis's value
// to all points that are done and have the figure as a finite number, whether they meet the constraints or not. An
// effect is stated as the difference from the reference, which is the baseline's value, or the sweep's first value that
// a used point has where there is no baseline.
// - In a full grid this is the difference between the means over all other parameters (main effects).
// - With one parameter changed at a time it is the figure of the changed point less the baseline's, exactly.
// - In random and Latin hypercube designs, and where points are missing, effects are adjusted for the other parameters'
//   values, which the points do not have equally often. Where there are more unknowns than points, or more than
//   kMostUnknowns, the axis of numbers that has the most values is taken as a straight line over its numbers instead,
//   then the next; so all axes of a Latin hypercube whose points share no value are lines.
// - What the points leave open (two parameters that always changed together) has no value.
// What effects do not explain, the parameters do together (interactions), or the lines bend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

inline constexpr std::size_t kMostUnknowns = 512;

enum class DesignKind {
  grid,           // every combination of the values that occur, once
  one_at_a_time,  // no point differs from the baseline in more than one parameter
  scattered,      // anything else
};

enum class Effects {
  by_value,     // of each value
  by_line,      // a straight line over the axis's numbers
  undetermined  // the points leave it open, or the values are too many and no numbers
};

struct Sensitivity {
  std::size_t axis = 0;
  Effects effects = Effects::undetermined;
  std::size_t reference = 0;                       // value
  std::vector<std::uint64_t> points;               // that were used, a value each
  std::vector<std::optional<double>> differences;  // from the reference, a value each; in the objective's unit
  // Of values that have a difference: where the objective is least and most, and how much lies between.
  std::size_t least_at = 0;
  std::size_t most_at = 0;
  std::optional<double> span;  // none where fewer than two values have a difference
  // The variance of the effects over the used points, of the figure's: in a full grid the shares and what is
  // unexplained add up to 1. None where the figure does not vary or a used value has no difference.
  std::optional<double> share;
};

struct ObjectiveSensitivity {
  DesignKind design = DesignKind::scattered;
  std::uint64_t points = 0;    // used
  std::uint64_t unknowns = 0;  // that they determine; as many as points: nothing is left to tell how good the fit is
  std::uint64_t infinite = 0;  // done points whose figure is infinite, left out
  double mean = 0.0;           // of the used points
  std::optional<double> unexplained;  // part of the figure's variance; none where nothing is left to tell
  std::vector<Sensitivity> axes;      // an axis each, in the table's order
};

// An objective each. Throws std::invalid_argument where a row has not a value for each axis and a figure for each
// objective.
std::vector<ObjectiveSensitivity> find_sensitivity(const SweepTable& table);

}  // namespace rastertlm::explore
