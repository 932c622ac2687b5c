// The exact picture of spheres, solids or not of the meshes that stand for them: what a machine's picture lacks of it
// is a mesh's fault as well.
#pragma once

#include <cstddef>

#include "src/frame/frame.h"
#include "src/scene/scene.h"

namespace rastertlm::reference {

// Whether every object of the scene is a sphere.
bool is_of_spheres(const scene::Scene& scene);

// The spheres of the scene at `pose`, which was made for this screen's aspect ratio: each pixel's ray hits the nearest
// between the near and the far plane, and a solid that the near plane cuts shows the cut; lights where they are, the
// viewer at the eye where the view is perspective. Levels are 255 times the light, clamped to 0..255;
// ExactFrame::object is the sphere's number, from 1; depth is 0 at the near plane and 1 at the far one.
frame::ExactFrame render_spheres(const scene::Scene& scene, const scene::Pose& pose, std::size_t columns,
                                 std::size_t lines);

}  // namespace rastertlm::reference
