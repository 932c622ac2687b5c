// One simulation: a machine and a scene in, figures and pictures out. Touches no file but those that it reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/frame/frame.h"
#include "src/parameter/table.h"
#include "src/run/result.h"
#include "src/run/timeline.h"

namespace rastertlm::run {

// Exact pictures that several simulations want.
class ExactStore {
 public:
  virtual ~ExactStore() = default;
  // The picture of that key, 64 hexadecimal digits; `render` makes it. Pictures of equal keys are equal.
  virtual frame::ExactFrame picture(const std::string& key, const std::function<frame::ExactFrame()>& render) = 0;
};

struct Options {
  std::uint64_t frames = 1;                    // displayed frames
  bool model_everything = false;               // simulate also what the scene does not need; the figures are the same
  bool reference = true;                       // render the exact pictures and measure the error
  bool host_figures = false;                   // fill Result::host
  ExactStore* exact = nullptr;                 // where exact pictures are looked for; none: each is rendered
  std::optional<TimelineRange> timeline = {};  // fill Result::timeline
  // Measure FLIP and CIEDE2000 too, at so many pixels a degree. They take longer than everything else.
  std::optional<double> perceptual_pixels_per_degree = {};
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

// Reads both files; `arguments` are those of --set. Throws InputError with everything that is wrong in both.
Inputs read_inputs(const std::string& machine_file, const std::string& scene_file,
                   const std::vector<std::string>& arguments);

// What was read, every key with its value and where that came from, as files that read back as the same.
std::string resolved_machine_toml(const Inputs& inputs);
std::string resolved_scene_toml(const Inputs& inputs);

// SHA-256 of machine and scene, as the result has them.
std::string config_digest(const Inputs& inputs);
std::string scene_digest(const Inputs& inputs);

// The exact pictures that a simulation of so many frames asks for.
struct ExactNeeds {
  std::string key;           // equal where they are the same, as long as the machines keep up with the animation
  std::size_t pixels = 0;    // of each
  std::size_t pictures = 0;  // at most
};
ExactNeeds exact_needs(const Inputs& inputs, std::uint64_t frames);

// Once a process, for SystemC allows one simulation. Throws InputError where the machine cannot take the scene, and
// ModelError where a rule of the model is broken. `sink` is called once for each displayed frame, in order.
Result simulate(const Inputs& inputs, const Options& options, const FrameSink& sink);

// The declarations that `describe parameters` lists: "machine imogene", "scene".
std::vector<std::pair<std::string, parameter::Table>> described_tables();

}  // namespace rastertlm::run
