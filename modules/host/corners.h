// A corner of a triangle from object space to the screen.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "modules/set_up/pieces.h"
#include "src/geometry/frame_grid.h"
#include "src/geometry/projection.h"

namespace rastertlm::host {

// False where the corner in clip space needs the guard band; otherwise `screen` is where it stands.
template <class T>
bool on_screen(const geometry::ClipVertex<T>& clip, const geometry::SnapGrid& grid, const geometry::Viewport& viewport,
               geometry::ScreenVertex<T>& screen) {
  if (!geometry::within_depth(clip)) return false;
  screen = geometry::to_screen(clip, viewport);
  return geometry::within_samples(screen, grid, viewport);
}

}  // namespace rastertlm::host
