// rastertlm render: one machine, one scene, one directory of results.
#pragma once

#include <optional>
#include <vector>

#include "src/cli/command.h"
#include "src/reference/flip.h"
#include "src/run/simulate.h"

namespace rastertlm::cli {

class RenderCommand : public Command {
 public:
  std::string name() const override { return "render"; }
  std::string summary() const override { return "Simulate a machine that shows a scene, and report"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  std::string machine_ = "configs/machines/imogene.toml";
  std::string scene_ = "configs/scenes/teapot.toml";
  std::vector<std::string> overrides_;
  std::uint64_t frames_ = 1;
  std::string out_;
  double require_rate_ = 0.0;  // Hz; 0: not required
  double require_psnr_ = 0.0;  // dB; 0: not required
  bool model_everything_ = false;
  bool host_figures_ = false;
  bool no_reference_ = false;
  bool blame_ = false;
  bool perceptual_ = false;
  double pixels_per_degree_ = reference::kDefaultPixelsPerDegree;

  std::string timeline_frames_;
  std::string timeline_lines_;

  std::string output_directory() const;
  run::Options run_options() const;
};

// The sentences that say which requirement a run misses; none where it meets them. A rate is met also where the machine
// sustains its own rate and that is not below the required one: in whole pixel clocks 50 Hz may be 49.9999. The PSNR is
// that of the worst frame against the ideal picture.
std::vector<std::string> missed_requirements(const run::Result& result, double rate_hz, double psnr_db);

}  // namespace rastertlm::cli
