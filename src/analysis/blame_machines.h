// The frames of each kind of machine as blame() explains them.
#pragma once

#include <memory>
#include <vector>

#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/analysis/blame.h"

namespace rastertlm::analysis {

// One, or two where the displayed frame is two fields.
std::vector<std::unique_ptr<ExplainedFrame>> explained_frames(const run::Inputs& inputs,
                                                              const run::FramePixels& pixels);

// Of the pose; `shown` and `ideal` outlive it.
std::unique_ptr<ExplainedFrame> explained_imogene(const imogene::Machine& machine, const scene::Scene& scene,
                                                  const scene::Pose& pose, const frame::Frame& shown,
                                                  const frame::ExactFrame& ideal);
std::unique_ptr<ExplainedFrame> explained_quadratic(const quadratic::Machine& machine, const scene::Scene& scene,
                                                    const scene::Pose& pose, const frame::Frame& shown,
                                                    const frame::ExactFrame& ideal);

}  // namespace rastertlm::analysis
