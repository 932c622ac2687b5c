// rastertlm compare: how far apart two pictures are.
#pragma once

#include "src/cli/command.h"
#include "src/report/picture_comparison.h"

namespace rastertlm::cli {

class CompareCommand : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string summary() const override { return "Error figures between two pictures: levels, PSNR, FLIP, CIEDE2000"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  report::PictureFile first_;
  report::PictureFile second_;
  std::string error_map_;
  double pixels_per_degree_ = reference::kDefaultPixelsPerDegree;
};

}  // namespace rastertlm::cli
