// The animation unit's work: what changed since the last frame, and how large the message is that says so (004,
// section 5.2.4).
#pragma once

#include <cstdint>
#include <vector>

#include "modules/host/resident_scene.h"

namespace rastertlm::host {

// What the animation unit sends to every computation unit for one frame.
struct FrameWork {
  std::int64_t animation_frame = 0;
  bool initial = false;  // the first frame: everything is new
  geometry::Pose pose;
  std::vector<std::uint8_t> renew;  // one an object of the scene: its coefficients must be computed and written
  bool lights_changed = false;      // in eye space: the tables of the shading processor must be loaded
  std::uint64_t message_bytes = 0;
};

class Animation {
 public:
  // `send_all`: coefficients are computed and written again whether or not they changed.
  Animation(const ResidentScene& scene, bool send_all) : scene_(scene), send_all_(send_all) {}

  FrameWork frame_work(std::int64_t animation_frame, bool initial) const;
  // Whether any frame after the first differs from it.
  bool moves() const;
  // Whether the lights move in eye space.
  bool lights_change() const { return scene_.camera_moves; }

 private:
  const ResidentScene& scene_;
  bool send_all_;
};

}  // namespace rastertlm::host
