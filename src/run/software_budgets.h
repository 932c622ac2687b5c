// What a frame would take a computer that draws it in software, by shading method, beside the time that a frame has.
#pragma once

#include <vector>

#include "modules/host/software_renderer.h"
#include "src/run/result.h"

namespace rastertlm::run {

// Budgets "software.gouraud", "software.quadratic", "software.phong" of one frame; none of them applies to the machine.
std::vector<Budget> software_budgets(const host::SoftwareParameters& software, const host::Rendering& rendering,
                                     const geometry::Pose& pose, double frame_seconds);

}  // namespace rastertlm::run
