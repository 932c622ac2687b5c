// Where a triangle that was split meets one that was not, their common edge has two colours: coverage has no crack, but
// there is a step.
#pragma once

#include <cstdint>
#include <span>

#include "modules/set_up/span_load.h"

namespace rastertlm::set_up {

struct ColourSteps {
  std::uint64_t edges = 0;      // that one triangle has whole and its neighbours in parts, or in other parts
  double largest_levels = 0.0;  // of any channel anywhere along them
};

// Of a frame's triangles on one grid, parts of split ones in their place. Corners that are the same point are one.
// Those of parts lie exactly on the edges (`moved_bits` 0), or are midpoints of their parents', moved to multiples of
// 2^`moved_bits` steps.
ColourSteps colour_steps(std::span<const ColourTriangle> triangles, int moved_bits = 0);

}  // namespace rastertlm::set_up
