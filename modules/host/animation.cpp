#include "modules/host/animation.h"

#include <algorithm>

namespace rastertlm::host {
namespace {

// 32-bit words: a 4 x 4 matrix of an object or of the camera, a direction of a light, and a header with frame number
// and length.
constexpr std::uint64_t kHeaderBytes = 8;
constexpr std::uint64_t kMatrixBytes = 4 * 16;
constexpr std::uint64_t kLightBytes = 4 * 3;

}  // namespace

bool Animation::moves() const {
  return send_all_ || scene_.camera_moves ||
         std::any_of(scene_.objects.begin(), scene_.objects.end(),
                     [](const ResidentObject& object) { return object.moves; });
}

FrameWork Animation::frame_work(std::int64_t animation_frame, bool initial) const {
  FrameWork work;
  work.animation_frame = animation_frame;
  work.initial = initial;
  work.pose = scene_.pose(animation_frame);
  const bool camera = initial || scene_.camera_moves;
  work.lights_changed = camera;
  work.message_bytes = kHeaderBytes;
  if (camera) work.message_bytes += 2 * kMatrixBytes + kLightBytes * work.pose.lights.size();
  work.renew.resize(scene_.objects.size());
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const bool moved = initial || scene_.objects[i].moves;
    if (moved) work.message_bytes += kMatrixBytes;
    work.renew[i] = moved || camera || send_all_ ? 1 : 0;
  }
  return work;
}

}  // namespace rastertlm::host
