#include "src/cli/command.h"

#include <fmt/format.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <memory>
#include <new>
#include <vector>

#include "src/base/version.h"
#include "src/cli/certify_command.h"
#include "src/cli/compare_command.h"
#include "src/cli/describe_command.h"
#include "src/cli/explore_command.h"
#include "src/cli/render_command.h"
#include "src/cli/report_command.h"
#include "src/cli/stability_command.h"
#include "src/cli/usage.h"
#include "src/cli/vectors_command.h"

namespace rastertlm::cli {
namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done; 1 done, but a stated requirement is not met; 2 bad input or usage;\n"
    "3 a rule of the model or an internal check was broken; 4 the output could not be written;\n"
    "130 interrupted (SIGINT), 143 terminated (SIGTERM).\n"
    "explore run: 1 some points failed; all failed: 2 by bad values alone, else 3.";

using Commands = std::vector<std::unique_ptr<Command>>;

Commands all_commands() {
  Commands commands;
  commands.push_back(std::make_unique<RenderCommand>());
  commands.push_back(std::make_unique<ExploreCommand>());
  commands.push_back(std::make_unique<VectorsCommand>());
  commands.push_back(std::make_unique<StabilityCommand>());
  commands.push_back(std::make_unique<CertifyCommand>());
  commands.push_back(std::make_unique<ReportCommand>());
  commands.push_back(std::make_unique<CompareCommand>());
  commands.push_back(std::make_unique<DescribeCommand>());
  return commands;
}

// On standard error, each line with the program's name.
ExitCode fail(ExitCode code, const std::string& text) {
  std::string lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += "rastertlm: " + text.substr(begin, end - begin) + '\n';
    begin = end + 1;
  }
  std::fputs(lines.c_str(), stderr);
  return code;
}

// The first word that is no option names the sub-command.
std::string unknown_command(int argc, char** argv, const Commands& commands) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (const auto& command : commands) {
    if (command->name() == argv[1]) return {};
    names.push_back(command->name());
  }
  return unknown_word("sub-command", argv[1], names);
}

std::string no_command(const Commands& commands) {
  std::string text = "a sub-command is needed:";
  for (const auto& command : commands) text += fmt::format("\n  {:<10}{}", command->name(), command->summary());
  return text + "\nsee rastertlm --help";
}

ExitCode parse_and_run(int argc, char** argv) {
  const Commands commands = all_commands();
  CLI::App app(
      "rastertlm simulates raster graphics machines: does a machine show a scene at its rate, what limits it, and how "
      "far\n"
      "is its picture from the exact one?");
  app.footer(kFooter);
  app.set_version_flag("--version", fmt::format("rastertlm {}", kVersion));
  Command* chosen = nullptr;
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command->name(), command->summary());
    command->declare(*sub);
    sub->callback([&chosen, &command] { chosen = command.get(); });
  }
  const std::string unknown = unknown_command(argc, argv, commands);
  if (!unknown.empty()) return fail(ExitCode::kBadInput, unknown);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    const auto used = app.get_subcommands();
    return fail(ExitCode::kBadInput, left_over(used.empty() ? app : *used.front(), app.remaining(true)));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0)
      return fail(ExitCode::kBadInput, std::string(error.what()) + "\nsee rastertlm --help");
    app.exit(error);  // help and version
    return ExitCode::kDone;
  }
  if (chosen == nullptr) return fail(ExitCode::kBadInput, no_command(commands));
  return chosen->run();
}

// Results that did not reach standard output are not delivered.
ExitCode deliver(ExitCode code) {
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!failed || code == ExitCode::kBadInput || code == ExitCode::kModelBroken) return code;
  return fail(ExitCode::kOutputFailed, "cannot write to standard output");
}

}  // namespace

ExitCode run(int argc, char** argv) {
  // A file-size limit is an error of a write, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return deliver(parse_and_run(argc, argv));
  } catch (const InputError& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const OutputError& error) {
    return fail(ExitCode::kOutputFailed, error.what());
  } catch (const ModelError& error) {
    return fail(ExitCode::kModelBroken, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kModelBroken, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::kModelBroken, fmt::format("internal error: {}", error.what()));
  }
}

}  // namespace rastertlm::cli
