// rastertlm certify: the proved worst error of each step of a machine beside the worst that was seen.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/analysis/certificates.h"
#include "src/cli/command.h"

namespace rastertlm::cli {

class CertifyCommand : public Command {
 public:
  std::string name() const override { return "certify"; }
  std::string summary() const override { return "Prove the worst error of each step of a machine"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  std::vector<std::string> machines_{"configs/machines/imogene_quadrics.toml", "configs/machines/quadratic.toml",
                                     "configs/machines/adaptive.toml"};
  std::vector<std::string> overrides_;
  analysis::CertifyOptions options_;
  std::string json_;
};

}  // namespace rastertlm::cli
