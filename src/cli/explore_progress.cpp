#include "src/cli/explore_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "src/report/number_text.h"

namespace rastertlm::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";
constexpr auto kPause = std::chrono::milliseconds(200);
constexpr double kMinute = 60.0;
constexpr double kHour = 60.0 * kMinute;
constexpr double kDay = 24.0 * kHour;

}  // namespace

std::string rough_time(double seconds) {
  if (seconds < 2.0 * kMinute) return fmt::format("about {:.0f} s", std::ceil(seconds));
  if (seconds < 2.0 * kHour) return fmt::format("about {:.0f} minutes", std::ceil(seconds / kMinute));
  if (seconds < 2.0 * kDay) return fmt::format("about {:.0f} hours", std::ceil(seconds / kHour));
  return fmt::format("about {:.0f} days", std::ceil(seconds / kDay));
}

std::string progress_text(const explore::RunStatus& status) {
  using report::grouped;
  const std::uint64_t there = status.found + status.simulated;
  std::string text = fmt::format("{} of {} points", grouped(there), grouped(status.points));
  if (status.failed > 0) text += fmt::format(", {} failed", grouped(status.failed));
  if (status.simulated == 0 || status.seconds <= 0.0) return text;
  const double rate = static_cast<double>(status.simulated) / status.seconds;
  text += fmt::format(", {:.3g} points/s", rate);
  const std::uint64_t left = status.points - std::min(there, status.points);
  return text + fmt::format(", {} left", rough_time(static_cast<double>(left) / rate));
}

ExploreProgress::ExploreProgress() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ExploreProgress::~ExploreProgress() {
  if (terminal_) std::fputs(kClearLine, stderr);
}

void ExploreProgress::show(const explore::RunStatus& status) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kPause) return;
  last_ = now;
  std::fputs((kClearLine + progress_text(status)).c_str(), stderr);
}

}  // namespace rastertlm::cli
