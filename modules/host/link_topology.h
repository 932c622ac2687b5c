// Who feeds whom over the serial links. Node 0 is the animation unit, node k + 1 computation unit k.
#pragma once

#include <cstddef>
#include <vector>

#include "modules/host/parameters.h"

namespace rastertlm::host {

// The computation units that `node` feeds, in order. In a tree every processor keeps one link for whoever feeds it (the
// animation unit: for its user) and forwards on the others; in a chain it feeds the next alone.
inline std::vector<std::size_t> children(std::size_t node, std::size_t units, LinkTopology topology,
                                         std::size_t links) {
  const std::size_t fan_out = topology == LinkTopology::chain ? 1 : links - 1;
  std::vector<std::size_t> result;
  for (std::size_t child = node * fan_out + 1; child <= units && child <= (node + 1) * fan_out; ++child)
    result.push_back(child - 1);
  return result;
}

// Links between the animation unit and unit `unit`.
inline std::size_t hops(std::size_t unit, LinkTopology topology, std::size_t links) {
  const std::size_t fan_out = topology == LinkTopology::chain ? 1 : links - 1;
  std::size_t count = 0;
  for (std::size_t node = unit + 1; node > 0; node = (node - 1) / fan_out) ++count;
  return count;
}

}  // namespace rastertlm::host
