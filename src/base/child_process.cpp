#include "src/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>
#include <optional>
#include <system_error>

namespace rastertlm {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr char kWhole = 'w';  // ends bytes that are whole
constexpr int kPauseMs = 20;  // from a look at what the child uses to the next

// No handler of this process, no words of the library and no core file; it ends with who forked it.
void live_alone(pid_t parent) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE, SIGALRM, SIGXCPU})
    std::signal(signal, SIG_DFL);
  // Interrupts, which a terminal sends to both, are for who forked it.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  sigset_t unblocked;
  sigemptyset(&unblocked);
  ::sigprocmask(SIG_SETMASK, &unblocked, nullptr);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0 || ::dup2(nowhere, STDERR_FILENO) < 0) ::_exit(1);
}

[[noreturn]] void live(int end, const std::function<std::string()>& work) {
  try {
    write_all(end, work() + kWhole);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

// Pages of a process that are in memory; 0 where that is not known.
std::uint64_t resident_bytes(const std::string& process) {
  std::ifstream file("/proc/" + process + "/statm");
  std::uint64_t all = 0, resident = 0;
  file >> all >> resident;
  return file ? resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

double cpu_seconds(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
}

class Child {
 public:
  Child(pid_t process, int end, const ChildLimits& limits)
      : process_(process), end_(end), limits_(limits), held_(resident_bytes("self")) {}

  // Until it has said all, or went beyond a limit, which ends it.
  ChildOutcome wait() {
    ChildOutcome outcome;
    std::optional<ChildEnd> broken;
    try {
      broken = read_all(outcome.bytes);
    } catch (...) {
      end_it();
      throw;
    }
    if (broken) ::kill(process_, SIGKILL);
    const int status = end_of_it();
    const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0 && outcome.bytes.ends_with(kWhole);
    if (whole) outcome.bytes.pop_back();
    if (!whole) outcome.bytes.clear();
    if (!broken && WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.end = broken.value_or(whole ? ChildEnd::done : ChildEnd::stopped);
    return outcome;
  }

 private:
  // Its status, once it is gone.
  int end_of_it() const {
    ::close(end_);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }
  void end_it() const {
    ::kill(process_, SIGKILL);
    end_of_it();
  }

  std::optional<ChildEnd> read_all(std::string& bytes) {
    std::string piece(kPiece, '\0');
    for (;;) {
      pollfd wanted{end_, POLLIN, 0};
      const int ready = ::poll(&wanted, 1, kPauseMs);
      if (ready < 0 && errno != EINTR) return ChildEnd::stopped;
      if (ready <= 0) {
        if (const auto broken = broken_limit()) return broken;
        continue;
      }
      const ssize_t count = ::read(end_, piece.data(), piece.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return std::nullopt;
      bytes.append(piece, 0, static_cast<std::size_t>(count));
    }
  }

  std::optional<ChildEnd> broken_limit() const {
    if (cpu_seconds(process_) > limits_.cpu_seconds) return ChildEnd::out_of_time;
    if (resident_bytes(std::to_string(process_)) > held_ + limits_.memory_bytes) return ChildEnd::out_of_memory;
    return std::nullopt;
  }

  pid_t process_;
  int end_;
  ChildLimits limits_;
  std::uint64_t held_;
};

}  // namespace

void write_all(int descriptor, const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    written += static_cast<std::size_t>(count);
  }
}

ChildOutcome in_child(const ChildLimits& limits, const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process < 0) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw std::system_error(reason, std::generic_category(), "fork");
  }
  if (process == 0) {
    ::close(ends[0]);
    live_alone(parent);
    live(ends[1], work);
  }
  ::close(ends[1]);
  return Child(process, ends[0], limits).wait();
}

}  // namespace rastertlm
