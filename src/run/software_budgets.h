// What a frame would take a computer that draws it in software, by shading method, beside the time that a frame has.
#pragma once

#include <string>
#include <vector>

#include "modules/host/software_renderer.h"
#include "src/run/result.h"

namespace rastertlm::run {

// Budgets "software.gouraud" ... of a frame, the mean of those whose poses are given, at least one: by every method of
// the machine's platform for which there is a program, and by Phong. None of them applies to the machine.
std::vector<Budget> software_budgets(const host::SoftwareParameters& software, const host::Rendering& rendering,
                                     const std::string& platform, const std::vector<geometry::Pose>& poses,
                                     double frame_seconds);

}  // namespace rastertlm::run
