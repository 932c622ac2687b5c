#include "src/cli/report_command.h"

#include <cstdio>

#include "src/report/result_writer.h"

namespace rastertlm::cli {

void ReportCommand::declare(CLI::App& app) { app.add_option("DIR", directory_, "directory of the run")->required(); }

ExitCode ReportCommand::run() {
  std::string text;
  try {
    report::rebuild_reports(directory_, text);
  } catch (...) {
    std::fputs(text.c_str(), stdout);  // what was asked for can be read all the same
    throw;
  }
  std::fputs(text.c_str(), stdout);
  return ExitCode::kDone;
}

}  // namespace rastertlm::cli
