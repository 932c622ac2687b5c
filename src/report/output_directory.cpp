#include "src/report/output_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "src/base/errors.h"
#include "src/report/file_names.h"
#include "src/report/json_report.h"
#include "src/report/text_file.h"
#include "src/report/vectors_manifest.h"

namespace rastertlm::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPartial = ".partial-";
constexpr const char* kOld = "-old";          // what DIR was, for the moment of the exchange
constexpr const char* kRemoved = "-removed";  // a partial directory that is being removed
constexpr mode_t kDirectoryMode = 0777;       // less the umask
constexpr int kSignalExit = 128;

// What a signal has to remove. Whoever changes it, or the directories that it names, holds `guard`; the signal's thread
// takes it and never gives it back, so that nothing is made after it has removed.
struct Unfinished {
  std::mutex guard;
  std::string partial;
  std::vector<std::string> parents;
};

Unfinished& unfinished() {
  static auto* const state = new Unfinished;  // outlives every thread
  return *state;
}

bool exists(const std::string& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0;
}

bool is_directory(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

void remove_quietly(const std::string& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

// Who still writes finds the directory gone, and makes no new files while the old ones are removed.
void remove_partial(const std::string& partial, const std::vector<std::string>& parents) {
  if (!partial.empty()) {
    const std::string removed = partial + kRemoved;
    remove_quietly(::rename(partial.c_str(), removed.c_str()) == 0 ? removed : partial);
  }
  for (const std::string& parent : parents) ::rmdir(parent.c_str());
}

std::string parent_of(const std::string& path) {
  const std::string parent = fs::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

// The process of "NAME.partial-<pid>", "...-old" or "...-removed".
std::optional<long> process_of(const std::string& entry, const std::string& name) {
  const std::string prefix = name + kPartial;
  if (entry.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  std::size_t end = prefix.size();
  while (end < entry.size() && std::isdigit(static_cast<unsigned char>(entry[end])) != 0) ++end;
  const std::string rest = entry.substr(end);
  constexpr std::size_t kMostDigits = 10;
  if (end == prefix.size() || end - prefix.size() > kMostDigits || (!rest.empty() && rest != kOld && rest != kRemoved))
    return std::nullopt;
  return std::strtol(entry.c_str() + prefix.size(), nullptr, 10);
}

bool is_alive(long process) {
  if (process == static_cast<long>(::getpid())) return false;  // one of that number before us
  return process > 0 && (::kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM);
}

void remove_stale(const std::string& target) {
  const std::string name = fs::path(target).filename().string();
  std::error_code error;
  std::vector<std::string> stale;
  for (fs::directory_iterator entry(parent_of(target), error), end; !error && entry != end; entry.increment(error)) {
    const std::optional<long> process = process_of(entry->path().filename().string(), name);
    if (process && !is_alive(*process)) stale.push_back(entry->path().string());
  }
  for (const std::string& path : stale) remove_quietly(path);
}

bool holds_result(const std::string& directory) {
  const std::optional<std::string> report = read_text_file(directory + '/' + kReportJson);
  if (report && is_report(*report)) return true;
  const std::optional<std::string> manifest = read_text_file(directory + '/' + kVectorsManifest);
  return manifest && is_vectors_manifest(*manifest);
}

// "out", where runs without --out made "out/teapot_imogene": nothing in it but results of ours, which stay.
bool holds_results_alone(const std::string& directory) {
  std::error_code error;
  bool any = false;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->is_directory(error) || entry->is_symlink(error) || !holds_result(entry->path().string())) return false;
    any = true;
  }
  return any && !error;
}

void refuse_what_is_not_ours(const std::string& target) {
  if (!exists(target)) return;
  if (!is_directory(target)) throw InputError(Diagnostic{target, 0, "", "is not a directory; nothing was written"});
  if (!holds_result(target) && !holds_results_alone(target))
    throw InputError(
        Diagnostic{target, 0, "",
                   fmt::format("exists and holds no {} of rastertlm and no {} of its vectors, so it is not "
                               "replaced; name another --out, or remove it",
                               kReportJson, kVectorsManifest)});
}

std::string without_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

// DIR as it will be renamed: a link followed, and a name at the end, which "." and ".." have not.
std::string normal_form(const std::string& directory) {
  if (directory.empty()) throw InputError(Diagnostic{"--out", 0, "", "names no directory"});
  std::string normal = without_slash(fs::path(directory).lexically_normal().string());
  const std::string name = fs::path(normal).filename().string();
  std::error_code error;
  if (name != "." && name != ".." && !fs::is_symlink(normal, error)) return normal;
  const fs::path canonical = fs::canonical(normal, error);
  if (error) throw OutputError(output_message(directory, error.value()));
  return canonical.string();
}

std::vector<std::string> make_parents(const std::string& target) {
  std::vector<std::string> missing;
  for (std::string parent = parent_of(target); !exists(parent); parent = parent_of(parent)) missing.push_back(parent);
  std::reverse(missing.begin(), missing.end());
  std::vector<std::string> made;
  for (const std::string& parent : missing) {
    if (::mkdir(parent.c_str(), kDirectoryMode) == 0) {
      made.insert(made.begin(), parent);
    } else if (errno != EEXIST) {
      const int error = errno;
      remove_partial("", made);
      throw OutputError(output_message(parent, error));
    }
  }
  return made;
}

// The results of other runs, below the directory that was replaced.
void keep_subdirectories(const std::string& old, const std::string& target) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(old, error), end; !error && entry != end; entry.increment(error))
    if (entry->is_directory(error) && !entry->is_symlink(error)) names.push_back(entry->path().filename().string());
  for (const std::string& name : names) {
    const std::string from = fmt::format("{}/{}", old, name);
    const std::string to = fmt::format("{}/{}", target, name);
    if (::rename(from.c_str(), to.c_str()) != 0) throw OutputError(output_message(to, errno));
  }
}

// Partial and target change places (std::exchange would be found under its name, and do something else); gives the name
// that what DIR was has now.
std::string change_places(const std::string& partial, const std::string& target) {
  if (::renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) return partial;
  // Not every file system can do it at once.
  std::string old = partial + kOld;
  if (::rename(target.c_str(), old.c_str()) != 0) throw OutputError(output_message(target, errno));
  if (::rename(partial.c_str(), target.c_str()) != 0) {
    const int error = errno;
    if (::rename(old.c_str(), target.c_str()) != 0)
      throw OutputError(output_message(old + " back to " + target, errno));
    throw OutputError(output_message(target, error));
  }
  return old;
}

void wait_for_signal(sigset_t signals) {
  int signal = 0;
  if (::sigwait(&signals, &signal) != 0) return;
  Unfinished& state = unfinished();
  state.guard.lock();  // for good
  remove_partial(state.partial, state.parents);
  const std::string message =
      fmt::format("rastertlm: {}: nothing was written\n", signal == SIGINT ? "interrupted" : "terminated");
  if (::write(STDERR_FILENO, message.data(), message.size()) < 0) ::_exit(kSignalExit + signal);
  ::_exit(kSignalExit + signal);
}

}  // namespace

OutputDirectory::OutputDirectory(const std::string& directory) : target_(normal_form(directory)) {
  refuse_what_is_not_ours(target_);
  Unfinished& state = unfinished();
  const std::lock_guard lock(state.guard);
  remove_stale(target_);
  parents_ = make_parents(target_);
  partial_ = target_ + kPartial + std::to_string(::getpid());
  if (::mkdir(partial_.c_str(), kDirectoryMode) != 0) {
    const int error = errno;
    remove_partial("", parents_);
    throw OutputError(output_message(partial_, error));
  }
  state.partial = partial_;
  state.parents = parents_;
}

OutputDirectory::~OutputDirectory() {
  Unfinished& state = unfinished();
  const std::lock_guard lock(state.guard);
  if (!committed_) remove_partial(partial_, parents_);
  state.partial.clear();
  state.parents.clear();
}

std::string OutputDirectory::path(const std::string& name) const { return partial_ + '/' + name; }

void OutputDirectory::commit() {
  Unfinished& state = unfinished();
  const std::lock_guard lock(state.guard);
  refuse_what_is_not_ours(target_);
  if (exists(target_)) {
    const std::string old = change_places(partial_, target_);
    committed_ = true;
    keep_subdirectories(old, target_);
    remove_quietly(old);
  } else {
    if (::rename(partial_.c_str(), target_.c_str()) != 0) throw OutputError(output_message(target_, errno));
    committed_ = true;
  }
  state.partial.clear();
  state.parents.clear();
}

void OutputDirectory::remove_on_signals() {
  static std::once_flag once;
  std::call_once(once, [] {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    // Threads inherit the mask: the signals come to none but the one that waits for them.
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread(wait_for_signal, signals).detach();
  });
}

}  // namespace rastertlm::report
