// What simulate() works on: the machine and the scene, with what is needed to write them down again.
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "platforms/adaptive/machine.h"
#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/base/errors.h"
#include "src/config/origins.h"
#include "src/run/simulate.h"
#include "src/scene/scene.h"

namespace rastertlm::run {

// Whether --set means the scene by that path. Where both files might have it, the machine does.
bool names_scene(const std::string& path);

struct Inputs::Content {
  std::string machine_file;
  std::string scene_file;
  std::variant<imogene::Machine, quadratic::Machine, adaptive::Machine> machine;
  config::Origins machine_origins;
  scene::SceneDescription description;
  config::Origins scene_origins;
  std::shared_ptr<const scene::Scene> scene;  // that simulations of the same scene share

  // Throws InputError where the machine file names another platform; `command` is what the program was asked for.
  const imogene::Machine& object_machine(const std::string& command) const;

  // Throws InputError where the scene has solids and `command` knows triangles alone.
  void refuse_solids(const std::string& command) const;

  // What a machine finds wrong with its own file or with the scene, with file and line.
  InputError located(const InputError& error) const;
};

}  // namespace rastertlm::run
