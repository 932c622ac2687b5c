#include "src/analysis/blame_machines.h"

#include <variant>

namespace rastertlm::analysis {
namespace {

// Of machines with a span unit; null for others.
const quadratic::Machine* span_machine(const run::Inputs& inputs) {
  if (const auto* machine = std::get_if<adaptive::Machine>(&inputs.content->machine)) return machine;
  return std::get_if<quadratic::Machine>(&inputs.content->machine);
}

}  // namespace

std::vector<std::unique_ptr<ExplainedFrame>> explained_frames(const run::Inputs& inputs,
                                                              const run::FramePixels& pixels) {
  const scene::Scene& scene = *inputs.content->scene;
  const frame::Frame& shown = pixels.shown;
  const run::FrameFigures& figures = pixels.figures;
  const auto pose = [&](std::int64_t frame) { return scene::pose(scene, frame, shown.columns, shown.lines); };
  std::vector<std::unique_ptr<ExplainedFrame>> frames;
  if (const quadratic::Machine* machine = span_machine(inputs)) {
    frames.push_back(explained_quadratic(*machine, scene, pose(figures.animation_frame), shown, *pixels.ideal));
    return frames;
  }
  const auto& machine = std::get<imogene::Machine>(inputs.content->machine);
  frames.push_back(explained_imogene(machine, scene, pose(figures.animation_frame), shown, *pixels.ideal));
  if (machine.video.interlaced)
    frames.push_back(explained_imogene(machine, scene, pose(figures.last_animation_frame), shown, *pixels.ideal));
  return frames;
}

}  // namespace rastertlm::analysis
