// Runs the program as a user does, in a folder of its own.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace rastertlm::test {

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  int signal = 0;
  std::string out;  // standard output
  std::string err;  // standard error
};

inline std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A temporary folder, removed at the end, in which the program runs.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "rastertlm_run_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::filesystem::create_directories(in_folder("run"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // The program runs in `run`; what it prints goes to files beside that.
  std::string in_folder(const std::string& name) const { return folder_ + '/' + name; }
  std::string in_work(const std::string& name) const { return folder_ + "/run/" + name; }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(in_work(name)).parent_path());
    std::ofstream(in_work(name), std::ios::binary) << text;
  }

  std::set<std::string> names(const std::string& folder = "") const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(in_work(folder)))
      found.insert(entry.path().filename().string());
    return found;
  }

  // Its process number. `file_size`: bytes that a file may have.
  pid_t start(const std::vector<std::string>& arguments, std::optional<rlim_t> file_size = std::nullopt) const {
    const pid_t child = ::fork();
    if (child == 0) {
      become(arguments, file_size);
      ::_exit(127);
    }
    return child;
  }

  Outcome wait_for(pid_t child) const {
    int status = 0;
    Outcome outcome;
    if (::waitpid(child, &status, 0) != child) return outcome;
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = file_text(in_folder("stdout"));
    outcome.err = file_text(in_folder("stderr"));
    return outcome;
  }

  Outcome run(const std::vector<std::string>& arguments, std::optional<rlim_t> file_size = std::nullopt) const {
    return wait_for(start(arguments, file_size));
  }

  // Whether the condition came to hold within a minute.
  static bool wait_until(const std::function<bool()>& condition) {
    constexpr auto kPause = std::chrono::milliseconds(1);
    constexpr auto kLongest = std::chrono::seconds(60);
    const auto end = std::chrono::steady_clock::now() + kLongest;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(kPause);
    }
    return true;
  }

 private:
  void become(const std::vector<std::string>& arguments, std::optional<rlim_t> file_size) const {
    constexpr mode_t kMode = 0666;
    const int out = ::open(in_folder("stdout").c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    const int err = ::open(in_folder("stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    if (::dup2(out, STDOUT_FILENO) < 0 || ::dup2(err, STDERR_FILENO) < 0 || ::chdir(in_folder("run").c_str()) != 0)
      return;
    if (file_size) {
      const rlimit limit{*file_size, *file_size};
      if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return;
    }
    std::vector<std::string> words{RASTERTLM_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(RASTERTLM_PROGRAM, argv.data());
  }

  std::string folder_;
};

// A machine of 4 boards of 8 processors that shows 64 x 48, and scenes for it.
inline constexpr const char* kSmallMachine = R"(schema = 1
platform = "imogene"
[video]
columns = 64
lines = 48
[host]
computation_units = 4
processors_per_unit = 8
)";

inline constexpr const char* kSceneHead = R"(schema = 1
[[light]]
towards = [0.0, -1.0, 1.0]
[[material]]
name = "clay"
)";

inline const std::string& one_triangle() {
  static const std::string text = std::string(kSceneHead) + R"([[object]]
type = "triangles"
material = "clay"
two_sided = true
positions = [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 3.0]]
)";
  return text;
}

}  // namespace rastertlm::test
