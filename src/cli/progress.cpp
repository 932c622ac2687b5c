#include "src/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace rastertlm::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";

}  // namespace

Progress::Progress(std::uint64_t frames)
    : frames_(frames), terminal_(::isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {
  if (terminal_) std::fputs("simulating ...", stderr);
}

Progress::~Progress() {
  if (terminal_) std::fputs(kClearLine, stderr);
}

void Progress::frame_done() {
  ++done_;
  if (!terminal_) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left = elapsed / static_cast<double>(done_) * static_cast<double>(frames_ - done_);
  std::fputs(fmt::format("{}frame {} of {}, {:.0f} s left", kClearLine, done_, frames_, left).c_str(), stderr);
}

}  // namespace rastertlm::cli
