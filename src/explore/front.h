// The Pareto front: the points of a sweep that no other beats.
//
// Compared are the points that are done and meet every constraint; no other point is on the front or beats one. A point
// beats another if it is worse in no objective and better in at least one. Points that are equal in all objectives do
// not beat each other: all of them are on the front, or none. A missing figure (or one that is no number) is worse than
// any figure and equal to another missing one: a point with one is on the front only for what it has. An infinite
// figure is a figure. Without objectives all compared points are equal, so all are on the front.
// Points of different cases, which are the values of given axes, do not beat each other: each case has a front.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "src/explore/sweep_table.h"

namespace rastertlm::explore {

struct Front {
  std::vector<std::size_t> rows;                      // on the front, in the table's order
  std::vector<bool> compared;                         // a row each
  std::vector<std::optional<std::size_t>> beaten_by;  // a row each: of the front's rows the first that beats it
  bool has(std::size_t row) const { return compared[row] && !beaten_by[row]; }
};

// The row's values of the axes that are given, in their order; empty where none is.
std::vector<std::size_t> case_of(const SweepTable& table, const Row& row);

// Does this row take part?
bool is_compared(const Row& row);

// The order of two figures: below 0 where `a` is better, 0 where they are equal, above 0 where it is worse.
int compare_figures(const std::optional<double>& a, const std::optional<double>& b, Sense sense);

// Of n points in k objectives: n log n work for k up to 2, and about n^(2 - 1/(k - 1)) beyond, even where all are on
// the front. Throws std::invalid_argument where a row has not a figure for each objective.
Front find_front(const SweepTable& table);

}  // namespace rastertlm::explore
