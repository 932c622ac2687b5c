// One simulation: a machine and a scene in, figures and pictures out. Touches no file but those that it reads.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "src/parameter/table.h"
#include "src/run/result.h"

namespace rastertlm::run {

struct Options {
  std::uint64_t frames = 1;       // displayed frames
  bool model_everything = false;  // simulate also what the scene does not need; the figures are the same
  bool reference = true;          // render the exact pictures and measure the error
  bool host_figures = false;      // fill Result::host
};

// A machine and a scene, read, checked and resolved.
struct Inputs {
  struct Content;
  explicit Inputs(std::unique_ptr<Content> given);
  Inputs(Inputs&&) noexcept;
  Inputs& operator=(Inputs&&) noexcept;
  ~Inputs();
  std::unique_ptr<Content> content;
};

// Reads both files; `overrides` are the arguments of --set. Throws InputError with everything that is wrong in both.
Inputs read_inputs(const std::string& machine_file, const std::string& scene_file,
                   const std::vector<std::string>& overrides);

// What was read, every key with its value and where that came from, as files that read back as the same.
std::string resolved_machine_toml(const Inputs& inputs);
std::string resolved_scene_toml(const Inputs& inputs);

// Once a process, for SystemC allows one simulation. Throws InputError where the machine cannot take the scene, and
// ModelError where a rule of the model is broken. `sink` is called once for each displayed frame, in order.
Result simulate(const Inputs& inputs, const Options& options, const FrameSink& sink);

// The declarations that `describe parameters` lists: "machine imogene", "scene".
std::vector<std::pair<std::string, parameter::Table>> described_tables();

}  // namespace rastertlm::run
