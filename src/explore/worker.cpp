#include "src/explore/worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>
#include <thread>

#include "src/base/child_process.h"
#include "src/base/errors.h"
#include "src/base/message.h"
#include "src/explore/figures.h"
#include "src/explore/thumbnail.h"
#include "src/report/figure_path.h"

namespace rastertlm::explore {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr std::size_t kMostPrinted = 400;  // bytes of its last words that are kept

// A message begins with its size: one that ends early is none.
bool is_whole(const std::string& message) {
  std::uint64_t size = 0;
  if (message.size() < sizeof size) return false;
  std::memcpy(&size, message.data(), sizeof size);
  return message.size() == size;
}

std::string packed(const PointResult& result) {
  std::string message;
  put(message, std::uint64_t{0});
  put(message, static_cast<char>(result.state == State::done ? 1 : 0));
  put(message, result.error);
  put(message, result.seconds);
  put(message, result.report);
  put(message, result.thumbnail);
  put(message, result.machine_toml);
  put(message, result.scene_toml);
  put(message, static_cast<std::uint64_t>(result.figures.size()));
  for (const auto& [path, value] : result.figures) {
    put(message, path);
    put(message, static_cast<char>(value ? 1 : 0));
    put(message, value.value_or(0.0));
  }
  const std::uint64_t size = message.size();
  std::memcpy(message.data(), &size, sizeof size);
  return message;
}

PointResult unpacked(const std::string& message) {
  Unpacker unpacker(message);
  PointResult result;
  unpacker.number<std::uint64_t>();  // the size
  result.state = unpacker.number<char>() == 1 ? State::done : State::failed;
  result.error = unpacker.text();
  result.seconds = unpacker.number<double>();
  result.report = unpacker.text();
  result.thumbnail = unpacker.text();
  result.machine_toml = unpacker.text();
  result.scene_toml = unpacker.text();
  for (auto left = unpacker.number<std::uint64_t>(); left > 0; --left) {
    const std::string path = unpacker.text();
    const bool there = unpacker.number<char>() == 1;
    const auto value = unpacker.number<double>();
    result.figures.emplace_back(path, there ? std::optional(value) : std::nullopt);
  }
  return result;
}

void simulate(const Work& work, PointResult& result) {
  std::optional<SharedExactStore> shared;
  if (work.exact != nullptr) shared.emplace(*work.exact, work.renders);
  run::Options options;
  options.frames = work.frames;
  options.reference = work.reference;
  options.exact = shared ? &*shared : nullptr;
  const auto sink = [&](const run::FramePixels& pixels) {
    if (work.thumbnail && result.thumbnail.empty()) result.thumbnail = thumbnail(pixels.shown);
  };
  const auto start = std::chrono::steady_clock::now();
  const report::Contents contents{run::simulate(work.inputs, options, sink), false};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const report::Figures figures(contents);
  result.report = compressed(figures.json());
  const std::string machine = run::resolved_machine_toml(work.inputs);
  result.machine_toml = compressed(machine);
  for (const std::string& path : work.figures) result.figures.emplace_back(path, figure_of(path, figures, machine));
  if (work.scene_toml) result.scene_toml = compressed(run::resolved_scene_toml(work.inputs));
}

std::string message_of(const Work& work) {
  PointResult result;
  try {
    simulate(work, result);
  } catch (const std::bad_alloc&) {
    result = PointResult{};
    result.error = "out of memory";
  } catch (const std::exception& error) {
    result = PointResult{};
    result.error = error.what();
  }
  if (!result.error.empty()) result.state = State::failed;
  return packed(result);
}

// For a thread that has not asked for memory yet: it gets a heap of its own. What is given back to the system must be
// had again page by page; a worker that is gone soon keeps it.
//
// Returns what is never freed and never touched, so that what comes next begins with the first large page.
void* keep_memory() {
  constexpr int kLarge = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
  ::mallopt(M_TRIM_THRESHOLD, kLarge);
  // Large pages, where the system gives them: a worker would come to most of its time by small ones.
  constexpr std::size_t kPage = std::size_t{2} << 20, kArena = 8 * kPage, kHeader = 64;
  void* const block = std::malloc(kArena + kPage);
  if (block == nullptr) return nullptr;
  void* begin = block;
  std::size_t room = kArena + kPage;
  const bool found = std::align(kPage, kArena, begin, room) != nullptr;
  if (found) ::madvise(begin, kArena, MADV_HUGEPAGE);
  const std::size_t before = kArena + kPage - room;
  if (found && before > kHeader) return std::realloc(block, before - kHeader);
  std::free(block);
  return nullptr;
}

// The worker's life. It ends with who forked it; interrupts are for that one, who then ends it.
// Nothing may be thrown out of it: what is on the stack before it belongs to the other process, its workers too.
[[noreturn]] void live(const Work& work, pid_t parent, int pipe, int printed) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (printed >= 0) {
    ::dup2(printed, STDOUT_FILENO);
    ::dup2(printed, STDERR_FILENO);
  }
  std::string message;
  try {
    std::thread([&] {
      [[maybe_unused]] const void* const held = keep_memory();
      message = message_of(work);
    }).join();
  } catch (const std::system_error&) {
    message = message_of(work);  // no thread is to be had: as well without, if slower
  }
  write_all(pipe, message);
  ::close(pipe);  // who reads need not wait until all memory is given back
  ::_exit(0);
}

// Where pieces of messages arrive: memory that no worker inherits, so that it need not be copied to be written again.
char* inbox() {
  static char* const place = [] {
    void* const memory = ::mmap(nullptr, kPiece, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ::madvise(memory, kPiece, MADV_DONTFORK);
    return static_cast<char*>(memory);
  }();
  return place;
}

std::string last_words(int descriptor) {
  const off_t size = descriptor < 0 ? 0 : ::lseek(descriptor, 0, SEEK_END);
  if (size <= 0) return {};
  std::string text(std::min<std::size_t>(static_cast<std::size_t>(size), kMostPrinted), '\0');
  const ssize_t count = ::pread(descriptor, text.data(), text.size(), size - static_cast<off_t>(text.size()));
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

Worker::Worker(const Work& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw OutputError(fmt::format("no pipe for a worker: {}", std::strerror(errno)));
  printed_ = ::memfd_create("rastertlm_worker", MFD_CLOEXEC);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) live(work, parent, ends[1], printed_);
  const int error = errno;
  ::close(ends[1]);
  pipe_ = ends[0];
  if (process_ > 0) return;
  ::close(pipe_);
  if (printed_ >= 0) ::close(printed_);
  throw OutputError(fmt::format("no process for a worker: {}", std::strerror(error)));
}

Worker::~Worker() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ::close(pipe_);
  if (printed_ >= 0) ::close(printed_);
}

bool Worker::read() {
  const ssize_t count = ::read(pipe_, inbox(), kPiece);
  if (count < 0) return errno != EINTR && errno != EAGAIN;
  received_.append(inbox(), static_cast<std::size_t>(count));
  return count == 0;
}

PointResult Worker::result() {
  if (is_whole(received_)) return unpacked(received_);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  PointResult failed;
  failed.state = State::failed;
  failed.error = ending(status);
  return failed;
}

std::string Worker::ending(int status) const {
  std::string text =
      WIFSIGNALED(status)
          ? fmt::format("the simulation was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
          : fmt::format("the simulation ended early, with exit code {}", WEXITSTATUS(status));
  const std::string printed = last_words(printed_);
  return printed.empty() ? text : text + "; it printed: " + printed;
}

}  // namespace rastertlm::explore
