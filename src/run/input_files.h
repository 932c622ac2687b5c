// Machine and scene files from which many simulations are made: each file is read once, each scene is made once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "platforms/adaptive/machine.h"
#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/config/document.h"
#include "src/config/overrides.h"
#include "src/config/raw.h"
#include "src/parameter/table.h"
#include "src/run/inputs.h"
#include "src/run/simulate.h"

namespace rastertlm::run {

class InputFiles {
 public:
  // As read_inputs(). Inputs with the same scene share it.
  Inputs read(const std::string& machine_file, const std::string& scene_file,
              const std::vector<config::Override>& overrides);
  // A machine alone: the content has no scene.
  Inputs read_machine_alone(const std::string& machine_file, const std::vector<config::Override>& overrides);
  // As read(), where other values are still to come: the machine's own values need not fit each other.
  Inputs read_base(const std::string& machine_file, const std::string& scene_file,
                   const std::vector<config::Override>& overrides);

 private:
  struct MadeScene {
    scene::SceneDescription description;
    config::Origins origins;
    std::shared_ptr<const scene::Scene> scene;
  };
  Inputs read(const std::string& machine_file, const std::string& scene_file,
              const std::vector<config::Override>& overrides, bool complete);
  const config::Document& document(const std::string& file);
  void read_machine(const std::vector<config::Override>& overrides, bool complete, Inputs::Content& content,
                    Diagnostics& diagnostics);
  void read_scene(const std::vector<config::Override>& overrides, Inputs::Content& content, Diagnostics& diagnostics);
  const MadeScene* made_scene(const std::string& file, const std::vector<config::Override>& overrides,
                              Diagnostics& diagnostics);

  std::map<std::string, config::Document> documents_;
  std::map<std::string, MadeScene> scenes_;  // by file and overrides
};

// What --set may name for a machine and a scene, as they stand in their files.
class Settable {
 public:
  // Throws InputError with everything that is wrong in both files.
  Settable(InputFiles& files, const std::string& machine_file, const std::string& scene_file,
           const std::vector<config::Override>& overrides);
  Settable(const Settable&) = delete;
  Settable& operator=(const Settable&) = delete;

  struct Checked {
    std::string mistake;          // "" where the value is taken
    std::string unit;             // of the parameter; "": none
    bool integer = false;         // it takes whole numbers alone
    std::string text;             // the value as a reader knows it: text without quotes
    std::string standing;         // the value that the files give, in the same way
    parameter::Value value = {};  // as the parameter takes it
  };
  // Whether there is such a parameter, and takes that value. What only several values together break is not seen.
  Checked check(const std::string& path, const config::Raw& value);
  // The same without a value.
  Checked check(const std::string& path);

 private:
  Checked find(const std::string& path, const config::Raw* value);
  std::variant<imogene::Machine, quadratic::Machine, adaptive::Machine> machine_;
  scene::SceneDescription description_;
  parameter::Table machine_table_;
  parameter::Table scene_table_;
};

// The value of a parameter as a reader knows it: as in a file, text without quotes.
std::string plain_text(const parameter::Value& value);

// What --set says, for a value that is at hand.
config::Override override_of(const std::string& path, const config::Raw& value);

}  // namespace rastertlm::run
