// The worst colours, depths and coverage of a span unit that random and adversarial triangles find, solved and loaded
// as the host does it, against exact forms of their six colours.
#pragma once

#include <cstdint>

#include "platforms/quadratic/machine.h"
#include "src/analysis/measurement.h"

namespace rastertlm::analysis {

struct SpanSeen {
  std::uint64_t triangles = 0;
  std::uint64_t samples = 0;  // whose colours and depth were compared
  std::uint64_t ends = 0;     // samples at and beside the ends of spans
  double wrong = 0.0;         // of those, on the wrong side
  double solved = 0.0;        // levels: the solver alone, at quarters of a triangle
  double thin_solved = 0.0;   // the same of triangles below the altitude
  double registers = 0.0;     // levels: what stands in them against the solver's form
  double rounded = 0.0;       // levels: an output word against its register
  double level = 0.0;         // levels: the output against the six colours
  double depth = 0.0;         // units
};

// Triangles on the screen: of any form, thin, with an edge that is almost level. Nothing is solved in fixed point.
SpanSeen search_spans(const quadratic::Machine& machine, Numbers& numbers, std::int64_t triangles, double altitude);

// The registers of a colour after `steps` steps, half of them from line to line, against constants that rounding moves
// by half of the last place, all the same way: levels.
double longest_path_error(const span_unit::SpanUnitParameters& parameters, std::uint64_t steps);

}  // namespace rastertlm::analysis
