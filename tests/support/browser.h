// A page held against what it should show by one of the programs of tests/pages, in headless Chromium.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace rastertlm::test {

struct PageOutcome {
  int exit_code = -1;
  std::string out;  // the checks that failed
};

inline PageOutcome check_page(const std::string& program, const std::vector<std::string>& arguments) {
  std::string command = "python3 '" + std::string(RASTERTLM_SOURCE_DIR) + "/tests/pages/" + program + '\'';
  for (const std::string& argument : arguments) command += " '" + argument + '\'';
  PageOutcome outcome;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> block{};
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe))
    outcome.out.append(block.data(), count);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

}  // namespace rastertlm::test
