#include "src/cli/stability_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "src/analysis/stability.h"
#include "src/cli/usage.h"
#include "src/report/number_text.h"
#include "src/report/text_table.h"
#include "src/run/input_files.h"

namespace rastertlm::cli {
namespace {

std::string figure(double value) { return std::isinf(value) ? "none" : fmt::format("{:.4g}", value); }

// The part of the bound that is left.
std::string margin(const analysis::Measurement& m) {
  if (m.bound == 0.0 || std::isinf(m.measured)) return m.holds() ? "exact" : "-";
  return fmt::format("{:.3g} %", 100 * (1 - m.measured / m.bound));
}

std::string text_of(const analysis::Finding& finding) {
  report::TextTable table({{"input", report::Align::left},
                           {"measured", report::Align::right},
                           {"bound", report::Align::right},
                           {"unit", report::Align::left},
                           {"margin", report::Align::right},
                           {"verdict", report::Align::left}},
                          "  ");
  for (const analysis::Measurement& m : finding.measurements)
    table.row({m.what, figure(m.measured), figure(m.bound), m.unit, margin(m),
               fmt::format("{}, {}", m.kind == analysis::BoundKind::proved ? "proved" : "required",
                           m.holds() ? "holds" : "BROKEN")});
  return fmt::format("{} ({}): {}\n{}\n", finding.name, finding.step, finding.stresses, table.text());
}

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
}

ExitCode StabilityCommand::run() {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(overrides_, diagnostics);
  diagnostics.throw_if_any();
  const std::vector<analysis::HardCase> cases = chosen_of(analysis::read_hard_cases(cases_), chosen_);
  std::optional<std::int64_t> tries;
  if (tries_ > 0) tries = tries_;
  run::InputFiles files;
  std::size_t measured = 0;
  std::vector<std::string> broken;
  for (const std::string& file : machines_) {
    const run::Inputs machine = files.read_machine_alone(file, overrides);
    std::string text = fmt::format("{}, seed {}\n\n", file, seed_);
    for (const analysis::HardCase& one : cases) {
      const auto finding = analysis::examine(one, *machine.content, seed_, tries);
      if (!finding) continue;
      measured += finding->measurements.size();
      text += text_of(*finding);
      if (!finding->holds()) broken.push_back(fmt::format("{}: {}: {}", file, finding->name, finding->step));
    }
    std::fputs(text.c_str(), stdout);
  }
  std::string end =
      fmt::format("{}; cases with a broken one: {}\n", report::counted(measured, "bound", "bounds"), broken.size());
  for (const std::string& one : broken) end += fmt::format("broken: {}\n", one);
  std::fputs(end.c_str(), stdout);
  return broken.empty() ? ExitCode::kDone : ExitCode::kRequirementMissed;
}

}  // namespace rastertlm::cli
