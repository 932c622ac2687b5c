// The command line: which sub-command, and what its end means to the shell.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "src/base/errors.h"

namespace rastertlm::cli {

class Command {
 public:
  virtual ~Command() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;  // one line of the help
  virtual void declare(CLI::App& app) = 0;  // options and arguments
  // Throws InputError, ModelError, OutputError.
  virtual ExitCode run() = 0;
};

// Runs the program. What goes wrong is told on standard error; results go to standard output.
ExitCode run(int argc, char** argv);

}  // namespace rastertlm::cli
