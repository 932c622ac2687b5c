#include "src/explore/stop_signals.h"

#include <ctime>

namespace rastertlm::explore {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

void note(int signal) { stop_signal = signal; }

}  // namespace

StopSignals::StopSignals() {
  stop_signal = 0;
  sigset_t both;
  sigemptyset(&both);
  sigaddset(&both, SIGINT);
  sigaddset(&both, SIGTERM);
  ::sigprocmask(SIG_BLOCK, &both, &before_);
  struct sigaction action {};
  action.sa_handler = note;
  ::sigaction(SIGINT, &action, &interrupt_);
  ::sigaction(SIGTERM, &action, &terminate_);
}

StopSignals::~StopSignals() {
  ::sigaction(SIGINT, &interrupt_, nullptr);
  ::sigaction(SIGTERM, &terminate_, nullptr);
  ::sigprocmask(SIG_SETMASK, &before_, nullptr);
}

void StopSignals::wait(std::vector<pollfd>& descriptors, int milliseconds) const {
  const timespec limit{milliseconds / 1000, (milliseconds % 1000) * 1'000'000L};
  sigset_t open = before_;
  sigdelset(&open, SIGINT);
  sigdelset(&open, SIGTERM);
  if (::ppoll(descriptors.data(), descriptors.size(), &limit, &open) <= 0)
    for (pollfd& one : descriptors) one.revents = 0;
}

int StopSignals::received() { return stop_signal; }

}  // namespace rastertlm::explore
