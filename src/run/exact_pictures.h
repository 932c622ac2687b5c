// The exact pictures of a simulation: rendered by itself, or shared with simulations of the same scene on the same
// screen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/frame/frame.h"
#include "src/reference/renderer.h"
#include "src/run/simulate.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

// What a machine is compared with, in the order in which its report has them.
std::vector<reference::RenderOptions> exact_options(const imogene::Machine& machine);
std::vector<reference::RenderOptions> exact_options(const quadratic::Machine& machine);

class ExactPictures {
 public:
  ExactPictures(const scene::Scene& scene, ExactStore* store) : scene_(scene), store_(store) {}
  // Of the scene's animation frame, whose pose that is.
  frame::ExactFrame render(const scene::Pose& pose, std::int64_t animation_frame,
                           const reference::RenderOptions& options) const;
  // Of the spheres that its meshes stand for.
  frame::ExactFrame render_spheres(const scene::Pose& pose, std::int64_t animation_frame, std::size_t columns,
                                   std::size_t lines) const;

 private:
  const scene::Scene& scene_;
  ExactStore* store_;
};

}  // namespace rastertlm::run
