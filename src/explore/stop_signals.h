// SIGINT and SIGTERM as something to look at: they come only while wait() waits.
#pragma once

#include <poll.h>

#include <csignal>
#include <vector>

namespace rastertlm::explore {

class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals();

  // Waits for one of the descriptors, at most `milliseconds`.
  void wait(std::vector<pollfd>& descriptors, int milliseconds) const;
  // The signal that came; 0: none.
  static int received();

 private:
  sigset_t before_{};
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace rastertlm::explore
