// What simulate() works on: the machine and the scene, with what is needed to write them down again.
#pragma once

#include <string>

#include "platforms/imogene/machine.h"
#include "src/base/errors.h"
#include "src/config/origins.h"
#include "src/run/simulate.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

struct Inputs::Content {
  std::string machine_file;
  std::string scene_file;
  imogene::Machine machine;
  config::Origins machine_origins;
  scene::SceneDescription description;
  config::Origins scene_origins;
  scene::Scene scene;

  // What a machine finds wrong with its own file or with the scene, with file and line.
  InputError located(const InputError& error) const;
};

}  // namespace rastertlm::run
