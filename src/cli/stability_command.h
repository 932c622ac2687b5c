// rastertlm stability: how far machines are off on hard cases, beside what is proved of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/analysis/hard_case.h"
#include "src/cli/command.h"
#include "src/report/stability_report.h"
#include "src/run/inputs.h"

namespace rastertlm::cli {

class StabilityCommand : public Command {
 public:
  std::string name() const override { return "stability"; }
  std::string summary() const override { return "Measure errors on hard cases beside their proved bounds"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  void refuse_unused(const report::StabilityReport& found) const;
  std::vector<std::int64_t> tries_of(const std::vector<run::Inputs>& machines,
                                     const std::vector<analysis::HardCase>& cases) const;

  std::vector<std::string> machines_{"configs/machines/imogene.toml", "configs/machines/quadratic.toml",
                                     "configs/machines/adaptive.toml"};
  std::string cases_ = "configs/hard_cases";
  std::vector<std::string> chosen_;  // none: all
  std::vector<std::string> overrides_;
  std::uint64_t seed_ = 1;
  std::int64_t inputs_ = 0;  // of all cases together; 0: each case's own
  std::int64_t tries_ = 0;   // 0: each case's own
  std::string json_;         // a file, or - for standard output
};

}  // namespace rastertlm::cli
