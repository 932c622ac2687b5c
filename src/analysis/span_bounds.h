// What is proved of the colours and depths of machines with a span unit, for every triangle on the screen that is
// nowhere thinner than `altitude` pixels (its least height over a side).
//
// With L the longest side and D twice the area, D >= L altitude. The solver: its running bound (stability_solver.cpp)
// with every product of two offsets at most L^2, so that the sum of a linear form's terms is at most (|c2| + |c3|) L /
// altitude and that of a quadratic's (q2 + c23 + q3) (L / altitude)^2, six colours in 0..255: c2 and c3 within 1,020,
// q2 and q3 within 1,020, c23 within 2,040. The registers: constants rounded to nearest (span_unit::fraction_bound), on
// the longest path. Before that they are computed in double: at most 40 roundings in a row of terms of that size, over
// the way from corner 1 to the start, along the edge and along the line.
#pragma once

#include <cstdint>

#include "platforms/quadratic/machine.h"

namespace rastertlm::analysis {

inline constexpr double kThinnest = 1.0 / 16.0;  // pixels

// Levels. Infinite where nothing is proved: of printed solvers, of fixed point, of colours that are not clamped.
double solver_bound(const quadratic::Machine& machine, double altitude);
// The altitude of the thinnest triangle on the grid: corner to corner, a square of the grid in doubled area.
double thinnest_on_grid(const quadratic::Machine& machine);
// Levels; the steps of figure 6's registers with all words as they were computed.
double register_bound(const quadratic::Machine& machine, std::int64_t fraction_bits, double altitude);
// Units of the depth word, floor of the register included.
double depth_bound(const quadratic::Machine& machine, double altitude);
std::uint64_t longest_path(const quadratic::Machine& machine);

}  // namespace rastertlm::analysis
