#include "src/cli/stability_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "src/analysis/stability.h"
#include "src/cli/usage.h"
#include "src/report/stability_report.h"
#include "src/report/text_file.h"
#include "src/run/input_files.h"

namespace rastertlm::cli {
namespace {

constexpr std::uint64_t kMostInputs = 1'000'000'000'000;

std::vector<analysis::HardCase> chosen_of(std::vector<analysis::HardCase> all, const std::vector<std::string>& names) {
  if (names.empty()) return all;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const analysis::HardCase& one : all) known.push_back(one.name);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError({"--case", 0, "", unknown_word("case", name, known)});
  std::erase_if(all, [&](const auto& one) { return std::find(names.begin(), names.end(), one.name) == names.end(); });
  return all;
}

}  // namespace

void StabilityCommand::declare(CLI::App& app) {
  app.add_option("MACHINE", machines_, "machine files")->capture_default_str();
  app.add_option("--cases", cases_, "folder of the cases")->capture_default_str()->type_name("DIR");
  app.add_option("--case", chosen_, "run this case alone; may be given again")
      ->type_name("NAME")
      ->allow_extra_args(false);
  app.add_option("--set", overrides_, "path=value: set a parameter of the machines")
      ->type_name("path=value")
      ->allow_extra_args(false);
  app.add_option("--seed", seed_, "of random inputs")->capture_default_str()->type_name("N");
  app.add_option("--tries", tries_, "random inputs of each case, in place of its own")
      ->check(CLI::Validator([](std::string& text) { return whole_up_to(text, kMostInputs); }, "", ""))
      ->type_name("N");
  app.add_option("--inputs", inputs_, "random inputs of all cases together, most of them where they are cheap")
      ->check(CLI::Validator([](std::string& text) { return whole_up_to(text, kMostInputs); }, "", ""))
      ->excludes("--tries")
      ->type_name("N");
  app.add_option("--json", json_, "write what was found as JSON; - is standard output, in place of the tables")
      ->type_name("FILE");
}

// Of each machine and case, in that order; 0: the case's own.
std::vector<std::int64_t> StabilityCommand::tries_of(const std::vector<run::Inputs>& machines,
                                                     const std::vector<analysis::HardCase>& cases) const {
  if (inputs_ == 0) return std::vector<std::int64_t>(machines.size() * cases.size(), tries_);
  std::vector<analysis::CaseCost> costs;
  for (const run::Inputs& machine : machines)
    for (const analysis::HardCase& one : cases) costs.push_back(analysis::cost_of(one, *machine.content, seed_));
  return analysis::spread_inputs(costs, inputs_);
}

// A case that was asked for and that no machine has the step of would hold by silence.
void StabilityCommand::refuse_unused(const report::StabilityReport& found) const {
  Diagnostics diagnostics;
  for (const std::string& name : chosen_) {
    bool used = false;
    for (const report::MachineFindings& machine : found.machines)
      for (const auto& finding : machine.findings) used = used || finding.name == name;
    if (!used) diagnostics.add({"--case", 0, name, "none of these machines has what it stresses"});
  }
  diagnostics.throw_if_any();
}

ExitCode StabilityCommand::run() {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(overrides_, diagnostics);
  diagnostics.throw_if_any();
  const std::vector<analysis::HardCase> cases = chosen_of(analysis::read_hard_cases(cases_), chosen_);
  const bool tables = json_ != "-";
  run::InputFiles files;
  std::vector<run::Inputs> machines;
  for (const std::string& file : machines_) machines.push_back(files.read_machine_alone(file, overrides));
  const std::vector<std::int64_t> tries = tries_of(machines, cases);
  std::size_t next = 0;
  report::StabilityReport found{seed_, {}};
  for (std::size_t i = 0; i < machines_.size(); ++i) {
    report::MachineFindings& of_machine = found.machines.emplace_back();
    of_machine.file = machines_[i];
    for (const analysis::HardCase& one : cases) {
      const std::int64_t times = tries[next++];
      const auto given = times > 0 ? std::optional(times) : std::nullopt;
      if (auto finding = analysis::examine(one, *machines[i].content, seed_, given))
        of_machine.findings.push_back(*std::move(finding));
    }
    if (tables) std::fputs(report::findings_text(of_machine, seed_).c_str(), stdout);
  }
  refuse_unused(found);
  std::fputs(tables ? report::verdict_text(found).c_str() : report::stability_json(found).c_str(), stdout);
  if (tables && !json_.empty()) report::write_text_file(json_, report::stability_json(found));
  return found.broken().empty() ? ExitCode::kDone : ExitCode::kRequirementMissed;
}

}  // namespace rastertlm::cli
