#include "src/cli/certify_command.h"

#include <fmt/format.h>

#include <cstdio>

#include "src/cli/usage.h"
#include "src/report/number_text.h"
#include "src/report/text_file.h"
#include "src/run/input_files.h"

namespace rastertlm::cli {

void CertifyCommand::declare(CLI::App& app) {
  const auto validated = [](CLI::Option* option, std::string (*check)(const std::string&)) {
    return option->check(CLI::Validator([check](std::string& text) { return check(text); }, "", ""));
  };
  app.add_option("MACHINE", machines_, "machine files")->capture_default_str();
  app.add_option("--set", overrides_, "path=value: set a parameter of the machines")
      ->type_name("path=value")
      ->allow_extra_args(false);
  validated(app.add_option("--error", options_.wanted_levels, "levels for which the fewest bits of each width are told")
                ->capture_default_str()
                ->type_name("LEVELS"),
            finite_and_positive);
  validated(app.add_option("--exponent", options_.exponents,
                           "of the fewest bits, of those that the machine has; may be given again")
                ->type_name("N")
                ->allow_extra_args(false),
            whole_from_one);
  app.add_option("--seed", options_.seed, "of random inputs")->capture_default_str()->type_name("N");
  validated(app.add_option("--tries", options_.tries, "random inputs a step, before the adversarial search")
                ->capture_default_str()
                ->type_name("N"),
            whole_from_one);
  validated(
      app.add_option("--json", json_, "write the certificates for tools; - is standard output, in place of the tables")
          ->type_name("FILE"),
      not_empty);
}

ExitCode CertifyCommand::run() {
  Diagnostics diagnostics;
  const std::vector<config::Override> overrides = config::parse_overrides(overrides_, diagnostics);
  diagnostics.throw_if_any();
  const bool tables = json_ != "-";
  run::InputFiles files;
  std::vector<report::Certificates> machines;
  std::string broken;
  std::size_t steps = 0;
  for (const std::string& file : machines_) {
    const run::Inputs machine = files.read_machine_alone(file, overrides);
    report::Certificates found = analysis::certify(*machine.content, options_);
    found.machine = file;
    if (tables) std::fputs(report::certificates_text(found).c_str(), stdout);
    for (const report::Certificate& c : found.steps)
      if (!c.holds())
        broken += fmt::format("\n{}: {}: {:.9g} {} proved, {:.9g} seen", file, c.step, c.proved, c.unit, c.seen);
    steps += found.steps.size();
    machines.push_back(std::move(found));
  }
  std::fputs(tables ? fmt::format("{}\n", report::counted(steps, "certificate", "certificates")).c_str()
                    : report::certificates_json(machines).c_str(),
             stdout);
  if (tables && !json_.empty()) report::write_text_file(json_, report::certificates_json(machines));
  if (broken.empty()) return ExitCode::kDone;
  std::fputs(("rastertlm: broken certificates:" + broken + '\n').c_str(), stderr);
  return ExitCode::kModelBroken;
}

}  // namespace rastertlm::cli
