// Mach bands: how much more, or less, the slope of the levels jumps at edges between triangles than it should.
#pragma once

#include "src/frame/frame.h"
#include "src/reference/difference_sums.h"

namespace rastertlm::reference {

// At each of exact.edges, where the picture shows the same triangles as the exact one at the two pixels before the edge
// and the two beyond it, along a line or a column: the displayed jump of the first difference, (l3 - l2) - (l1 - l0),
// minus the exact one, of rounded levels. Of the region of the pixel before the edge.
RegionDifferences edge_jumps(const frame::Frame& shown, const frame::ExactFrame& exact);

}  // namespace rastertlm::reference
