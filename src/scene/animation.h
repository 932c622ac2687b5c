// Where things are at a frame. Everything is computed from the frame's number, never summed, so that a million frames
// do not drift. Several animations of one thing apply in the order of the file.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "src/scene/description.h"

namespace rastertlm::scene {

// An object's map to world space. spin: turned about the axis in the object's own space, before the placement. orbit:
// turned about the axis in world space, after it. keys: turned by rotate_deg (world axes) about the point where the
// object's origin is by then, and moved by translate, in addition to the placement.
glm::dmat4 animate(const glm::dmat4& placement, const std::vector<AnimationDescription>& animation, std::int64_t frame);

struct View {
  glm::dvec3 eye;
  glm::dvec3 target;
  glm::dvec3 up;
};

// The camera. spin: looks round from where it is (target and up turn about the axis through eye + centre). orbit: eye
// and up turn about the axis in world space; it keeps looking at its target. keys: target and up turn by rotate_deg
// about the eye, and all moves by translate.
View animate(const View& view, const std::vector<AnimationDescription>& animation, std::int64_t frame);

// Whether any frame differs from another.
bool moves(const std::vector<AnimationDescription>& animation);

// The key frames at `frame`: linear between two keys, held before the first and after the last. At least one key,
// frames increasing.
KeyDescription interpolate(const std::vector<KeyDescription>& keys, double frame);

}  // namespace rastertlm::scene
