// rastertlm report: the report of an earlier run, printed and made again.
#pragma once

#include "src/cli/command.h"

namespace rastertlm::cli {

class ReportCommand : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override { return "Print the report of an earlier run, made again from its report.json"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  std::string directory_;
};

}  // namespace rastertlm::cli
