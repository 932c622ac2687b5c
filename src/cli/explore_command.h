// rastertlm explore: many machines and scenes, a store of what they found.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/cli/command.h"

namespace rastertlm::cli {

class ExploreCommand : public Command {
 public:
  std::string name() const override { return "explore"; }
  std::string summary() const override { return "Simulate the points of a sweep; join and show what they found"; }
  void declare(CLI::App& app) override;
  ExitCode run() override;

 private:
  void declare_run(CLI::App& app);
  void declare_merge(CLI::App& app);
  void declare_show(CLI::App& app);
  ExitCode run_sweep();
  ExitCode merge();
  ExitCode show();
  std::string store_of(const std::string& sweep_name) const;

  const CLI::App* app_ = nullptr;
  std::string sweep_;
  std::string store_;
  std::size_t jobs_ = 0;  // 0: as many as there are processors
  std::string shard_;     // K/N; empty: all points
  bool resume_ = false;
  bool retry_ = false;
  bool yes_ = false;
  std::vector<std::string> parts_;
  bool csv_ = false;
  std::size_t rows_ = 40;
};

}  // namespace rastertlm::cli
