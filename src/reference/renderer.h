// The exact renderers: what a machine's picture is compared with. Everything is computed in double, a pixel at a time,
// and not rounded.
#pragma once

#include <cstddef>
#include <string>

#include "src/frame/frame.h"
#include "src/geometry/snapping.h"
#include "src/scene/scene.h"

namespace rastertlm::reference {

enum class Reference {
  ideal,  // the machine's own model: triangles' normals linear on the screen, infinite viewer and lights, vertices not
          // snapped
  snapped,     // the same, with vertices snapped to the frame's grid and exact coverage: a machine shows exactly these
               // pixels
  true_model,  // perspective-correct normals, local viewer, lights where they are, vertices not snapped
};

// "ideal", "snapped", "true".
std::string to_string(Reference reference);

struct RenderOptions {
  Reference kind = Reference::ideal;
  std::size_t columns = 0;
  std::size_t lines = 0;
  geometry::SnapGrids
      grids;  // of the machine: they choose the volume that triangles are clipped to, and the snapped vertices
  bool lights_at_points = false;  // the machine's model has them, positions linear on the screen as normals are
  bool specular_mean = false;     // one specular table a light: highlights take the mean of the light's channels
};

// The frame at `pose`, which was made for this screen's aspect ratio.
// - Triangles and solids are numbered through all objects of the scene in order, from 1 (Scene::object_count);
//   ExactFrame::object holds that number. The nearest wins, of equal depths the one with the lower number.
// - Solids are seen where a pixel's ray enters them between the near and the far plane, with the surface's own normal
//   there; where the near plane cuts one, the cut is seen, and faces the eye.
// - Triangles that face away are left out unless their object is two-sided; then their normals are turned. Facing is
// decided on the
//   screen, a piece at a time (after snapping, where vertices are snapped); pieces without area are left out.
// - Levels are 255 times the light that leaves the surface, clamped to 0..255; where nothing is seen, the scene's
// background.
// - ExactFrame::coverage counts the triangles and solids that cover a pixel, hidden ones too.
// Throws InputError for a light at a point where the model has none (ideal, snapped, without lights_at_points).
frame::ExactFrame render(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options);

}  // namespace rastertlm::reference
