#include "modules/host/animation.h"

#include <algorithm>

namespace rastertlm::host {
namespace {

// 32-bit words: a 4 x 4 matrix of an object or of the camera, a direction of a light, and a header with frame number and length.
constexpr std::uint64_t kHeaderBytes = 8;
constexpr std::uint64_t kMatrixBytes = 4 * 16;
constexpr std::uint64_t kLightBytes = 4 * 3;

}  // namespace

bool FrameWork::anything() const {
  return lights_changed || std::any_of(renew.begin(), renew.end(), [](std::uint8_t object) { return object != 0; });
}

Animation::Animation(const scene::Scene& scene, std::size_t columns, std::size_t lines, bool send_all)
    : scene_(scene), columns_(columns), lines_(lines), send_all_(send_all) {}

bool Animation::moves() const {
  if (send_all_ || scene::camera_moves(scene_)) return true;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i)
    if (scene::object_moves(scene_, i)) return true;
  return false;
}

FrameWork Animation::frame_work(std::int64_t animation_frame, bool initial) const {
  FrameWork work;
  work.animation_frame = animation_frame;
  work.initial = initial;
  work.pose = scene::pose(scene_, animation_frame, columns_, lines_);
  const bool camera = initial || scene::camera_moves(scene_);
  work.lights_changed = camera || send_all_;
  work.message_bytes = kHeaderBytes;
  if (camera) work.message_bytes += 2 * kMatrixBytes + kLightBytes * scene_.lights.size();
  work.renew.resize(scene_.objects.size());
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const bool moved = initial || scene::object_moves(scene_, i);
    if (moved) work.message_bytes += kMatrixBytes;
    work.renew[i] = moved || camera || send_all_ ? 1 : 0;
  }
  return work;
}

}  // namespace rastertlm::host
