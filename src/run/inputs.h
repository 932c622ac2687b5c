// What simulate() works on: the machine and the scene, with what is needed to write them down again.
#pragma once

#include <string>

#include "platforms/imogene/machine.h"
#include "src/config/origins.h"
#include "src/run/simulate.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

struct Inputs::Content {
  imogene::Machine machine;
  config::Origins machine_origins;
  scene::SceneDescription description;
  config::Origins scene_origins;
  scene::Scene scene;
};

}  // namespace rastertlm::run
