// Vectors as the program writes them, and what the independent reader says of them.
#pragma once

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace rastertlm::test {

inline const std::string kShippedMachine = RASTERTLM_SOURCE_DIR "/configs/machines/imogene.toml";
inline const std::string kShippedTeapot = RASTERTLM_SOURCE_DIR "/configs/scenes/teapot.toml";

class VectorsTest : public ProgramTest {
 protected:
  // Into `out`, which it replaces.
  Outcome vectors(const std::string& machine, const std::string& scene, const std::vector<std::string>& set = {},
                  std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"vectors", machine, scene, "--out", "out"};
    for (const std::string& one : set) {
      arguments.emplace_back("--set");
      arguments.push_back(one);
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  Outcome reread() const {
    const std::string command = std::string("'") + RASTERTLM_REREAD_VECTORS + "' '" + in_work("out") + "' > '" +
                                in_folder("said") + "' 2> '" + in_folder("complained") + "'";
    const int status = std::system(command.c_str());
    Outcome outcome;
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    outcome.out = file_text(in_folder("said"));
    outcome.err = file_text(in_folder("complained"));
    return outcome;
  }

  std::string text_of(const std::string& name) const { return file_text(in_work("out/" + name)); }

  // The rows of a file below its header, as cells.
  template <class Visit>
  void for_each_row(const std::string& name, const Visit& visit) const {
    std::istringstream text(text_of(name));
    std::string line;
    std::getline(text, line);
    while (std::getline(text, line)) {
      std::vector<std::string> row;
      std::istringstream stream(line);
      for (std::string cell; std::getline(stream, cell, ',');) row.push_back(cell);
      visit(row);
    }
  }

  // A number of the manifest, in which no key stands twice.
  std::uint64_t number(const std::string& key) const {
    const std::string manifest = text_of("manifest.json");
    const std::string quoted = '"' + key + "\": ";
    const std::size_t at = manifest.find(quoted);
    if (at == std::string::npos) throw std::runtime_error("no " + key);
    return std::stoull(manifest.substr(at + quoted.size()));
  }
};

}  // namespace rastertlm::test
