// rastertlm explore: many machines and scenes, a store of what they found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/cli/command.h"
#include "src/explore/sweep_table.h"

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
  std::optional<std::size_t> chosen_row(const explore::SweepTable& table) const;
  std::string shown(const explore::SweepTable& table) const;
  std::string store_of(const std::string& sweep_name) const;

  const CLI::App* app_ = nullptr;
  std::string sweep_;
  std::vector<std::string> overrides_;
  std::string store_;
  std::size_t jobs_ = 0;  // 0: as many as there are processors
  std::string shard_;     // K/N; empty: all points
  bool resume_ = false;
  bool retry_ = false;
  bool yes_ = false;
  std::vector<std::string> parts_;
  bool csv_ = false;
  bool csv_sensitivity_ = false;
  bool csv_steps_ = false;
  bool list_ = false;
  std::string html_;
  std::optional<std::uint64_t> point_;
  double tolerance_ = 0.0;
  std::size_t rows_ = 40;
};

}  // namespace rastertlm::cli
