// rastertlm describe: what there is to choose from.
#pragma once

#include "src/cli/command.h"

namespace rastertlm::cli {

class DescribeCommand : public Command {
 public:
  std::string name() const override { return "describe"; }
  std::string summary() const override {
    return "List machines, scenes, sweeps, presets, parameters, methods or statistics";
  }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  std::string topic_;
};

}  // namespace rastertlm::cli
