// How well a machine that looks for highlights finds them, against looking everywhere.
#pragma once

#include "platforms/quadratic/machine.h"
#include "src/run/result.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

// Adds to the figures of a frame in that pose. Nothing for a method that does not look for highlights.
void add_highlight_recall(const quadratic::Machine& machine, const scene::Scene& scene, const scene::Pose& pose,
                          HighlightFigures& figures);

}  // namespace rastertlm::run
