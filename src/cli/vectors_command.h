// rastertlm vectors: one frame of a machine and a scene, as stimulus and expected response for an RTL test bench.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/cli/command.h"

namespace rastertlm::cli {

class VectorsCommand : public Command {
 public:
  std::string name() const override { return "vectors"; }
  std::string summary() const override {
    return "Write a frame's stimulus and expected response for an RTL test bench";
  }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  std::string machine_ = "configs/machines/imogene.toml";
  std::string scene_ = "configs/scenes/teapot.toml";
  std::vector<std::string> overrides_;
  std::uint64_t frame_ = 0;
  std::uint64_t field_ = 0;
  std::string out_;
  std::string processors_;  // FROM-TO; empty: all
};

}  // namespace rastertlm::cli
