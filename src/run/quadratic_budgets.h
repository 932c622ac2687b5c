// What a frame of a span unit's machine needs of each resource beside what there is, and what follows for its rate.
#pragma once

#include <vector>

#include "platforms/quadratic/quadratic.h"
#include "src/run/result.h"

namespace rastertlm::run {

std::vector<Budget> quadratic_budgets(const quadratic::Quadratic& platform);
// What limits this frame: utilisation is the part of a frame that it takes.
Bottleneck frame_bottleneck(const quadratic::Quadratic& platform, const quadratic::ShownFrame& frame);
Answer quadratic_answer(const quadratic::Quadratic& platform, const std::vector<Budget>& budgets);
// Sentences: words that are too narrow for the screen, triangles that are not as their method has them, screens that
// show what is being drawn. `displayed`: how many of the frames are.
std::vector<std::string> quadratic_warnings(const quadratic::Quadratic& platform, std::uint64_t displayed);

}  // namespace rastertlm::run
