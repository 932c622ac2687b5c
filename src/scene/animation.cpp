#include "src/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/scene/transform.h"

namespace rastertlm::scene {
namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

glm::dvec3 transform(const glm::dmat4& m, const glm::dvec3& point) { return glm::dvec3(m * glm::dvec4(point, 1.0)); }
glm::dvec3 turn(const glm::dmat4& m, const glm::dvec3& direction) { return glm::dvec3(m * glm::dvec4(direction, 0.0)); }

glm::dmat4 rotation(const AnimationDescription& animation, std::int64_t frame) {
  return rotation_deg(vector(animation.axis), animation.deg_per_frame * static_cast<double>(frame));
}

glm::dmat4 apply(const glm::dmat4& m, const AnimationDescription& animation, std::int64_t frame) {
  switch (animation.kind) {
    case AnimationKind::spin:
      return m * about(vector(animation.centre), rotation(animation, frame));
    case AnimationKind::orbit:
      return about(vector(animation.centre), rotation(animation, frame)) * m;
    case AnimationKind::keys:
      break;
  }
  const KeyDescription key = interpolate(animation.keys, static_cast<double>(frame));
  const glm::dvec3 origin(m[3]);
  return translation(vector(key.translate)) * about(origin, rotation_xyz_deg(vector(key.rotate_deg))) * m;
}

View apply(const View& view, const AnimationDescription& animation, std::int64_t frame) {
  View result = view;
  switch (animation.kind) {
    case AnimationKind::spin: {
      const glm::dmat4 r = rotation(animation, frame);
      const glm::dmat4 m = about(view.eye + vector(animation.centre), r);
      result = {transform(m, view.eye), transform(m, view.target), turn(r, view.up)};
      break;
    }
    case AnimationKind::orbit: {
      const glm::dmat4 r = rotation(animation, frame);
      result.eye = transform(about(vector(animation.centre), r), view.eye);
      result.up = turn(r, view.up);
      break;
    }
    case AnimationKind::keys: {
      const KeyDescription key = interpolate(animation.keys, static_cast<double>(frame));
      const glm::dmat4 r = rotation_xyz_deg(vector(key.rotate_deg));
      const glm::dvec3 by = vector(key.translate);
      result = {view.eye + by, transform(about(view.eye, r), view.target) + by, turn(r, view.up)};
      break;
    }
  }
  return result;
}

Triple between(const Triple& a, const Triple& b, double t) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = (1.0 - t) * a[i] + t * b[i];
  return result;
}

}  // namespace

glm::dmat4 animate(const glm::dmat4& placement, const std::vector<AnimationDescription>& animation,
                   std::int64_t frame) {
  glm::dmat4 m = placement;
  for (const AnimationDescription& a : animation) m = apply(m, a, frame);
  return m;
}

View animate(const View& view, const std::vector<AnimationDescription>& animation, std::int64_t frame) {
  View result = view;
  for (const AnimationDescription& a : animation) result = apply(result, a, frame);
  return result;
}

bool moves(const std::vector<AnimationDescription>& animation) {
  return std::any_of(animation.begin(), animation.end(), [](const AnimationDescription& a) {
    if (a.kind != AnimationKind::keys) return std::fmod(a.deg_per_frame, 360.0) != 0.0;
    return std::any_of(a.keys.begin(), a.keys.end(), [&](const KeyDescription& key) {
      return key.translate != a.keys.front().translate || key.rotate_deg != a.keys.front().rotate_deg;
    });
  });
}

KeyDescription interpolate(const std::vector<KeyDescription>& keys, double frame) {
  const auto after =
      std::find_if(keys.begin(), keys.end(), [&](const KeyDescription& key) { return key.frame > frame; });
  if (after == keys.begin()) return keys.front();
  if (after == keys.end()) return keys.back();
  const KeyDescription& before = *(after - 1);
  const double t = (frame - before.frame) / (after->frame - before.frame);
  return {frame, between(before.translate, after->translate, t), between(before.rotate_deg, after->rotate_deg, t)};
}

}  // namespace rastertlm::scene
