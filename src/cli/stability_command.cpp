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
      ->check(CLI::Validator([](std::string& text) { return whole_from_one(text); }, "", ""))
      ->type_name("N");
  app.add_option("--json", json_, "write what was found as JSON; - is standard output, in place of the tables")
      ->type_name("FILE");
}

ExitCode StabilityCommand::run() {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(overrides_, diagnostics);
  diagnostics.throw_if_any();
  const std::vector<analysis::HardCase> cases = chosen_of(analysis::read_hard_cases(cases_), chosen_);
  std::optional<std::int64_t> tries;
  if (tries_ > 0) tries = tries_;
  const bool tables = json_ != "-";
  run::InputFiles files;
  report::StabilityReport found{seed_, {}};
  for (const std::string& file : machines_) {
    const run::Inputs machine = files.read_machine_alone(file, overrides);
    report::MachineFindings& of_machine = found.machines.emplace_back();
    of_machine.file = file;
    for (const analysis::HardCase& one : cases)
      if (auto finding = analysis::examine(one, *machine.content, seed_, tries))
        of_machine.findings.push_back(*std::move(finding));
    if (tables) std::fputs(report::findings_text(of_machine, seed_).c_str(), stdout);
  }
  std::fputs(tables ? report::verdict_text(found).c_str() : report::stability_json(found).c_str(), stdout);
  if (tables && !json_.empty()) report::write_text_file(json_, report::stability_json(found));
  return found.broken().empty() ? ExitCode::kDone : ExitCode::kRequirementMissed;
}

}  // namespace rastertlm::cli
