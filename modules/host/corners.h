// A corner of a triangle from object space to the screen.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "modules/set_up/pieces.h"
#include "src/geometry/frame_grid.h"
#include "src/geometry/projection.h"

namespace rastertlm::host {

template <class T>
struct CornerOnScreen {
  geometry::ClipVertex<T> clip{};
  geometry::ScreenVertex<T> screen{};  // where it needs no guard band
  bool needs_guard = true;
};

template <class T>
CornerOnScreen<T> corner_on_screen(const glm::dvec3& position, const glm::dvec3& normal,
                                   const glm::dmat4& object_to_clip, const glm::dmat3& normal_to_eye,
                                   const geometry::SnapGrid& on_screen, const geometry::Viewport& viewport) {
  CornerOnScreen<T> corner;
  corner.clip = set_up::transform_vertex<T>(position, normal, object_to_clip, normal_to_eye);
  if (!geometry::within_depth(corner.clip)) return corner;
  corner.screen = geometry::to_screen(corner.clip, viewport);
  corner.needs_guard = !geometry::within_samples(corner.screen, on_screen, viewport);
  return corner;
}

}  // namespace rastertlm::host
