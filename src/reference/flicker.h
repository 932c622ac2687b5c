// Flicker: how the error changes from frame to frame where nothing should.
#pragma once

#include <cstdint>
#include <vector>

#include "src/frame/frame.h"
#include "src/reference/difference_sums.h"

namespace rastertlm::reference {

// A pixel stands still where both frames' pictures cover it, and no channel's exact level differs by more from the
// frame before.
inline constexpr int kStillLevels = 1;

class FlickerMeter {
 public:
  // The change of the displayed minus the exact level since the frame before, at pixels that stand still, by this
  // frame's region; nothing of the first frame. Exact levels are rounded.
  RegionDifferences add(const frame::Frame& shown, const frame::ExactFrame& exact);

 private:
  // Planes that end with a whole group of the kernels: what lies behind the picture is not compared.
  struct Seen {
    std::vector<std::uint8_t> shown;
    std::vector<std::uint8_t> exact;     // rounded, as ExactLevels has them
    std::vector<std::uint8_t> compared;  // kComparedBefore where both pictures cover
  };
  Seen before_;
  Seen now_;
  std::vector<std::uint8_t> kind_;
};

}  // namespace rastertlm::reference
