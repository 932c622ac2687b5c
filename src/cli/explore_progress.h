// How far a sweep is, for who watches it.
#pragma once

#include <chrono>

#include "src/explore/runner.h"

namespace rastertlm::cli {

// Points done, failures, rate and the time that is left, on standard error where that is a terminal; nothing elsewhere.
class ExploreProgress {
 public:
  ExploreProgress();
  ExploreProgress(const ExploreProgress&) = delete;
  ExploreProgress& operator=(const ExploreProgress&) = delete;
  ~ExploreProgress();
  void show(const explore::RunStatus& status);

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point last_{};
};

// "about 3 hours", for an estimate.
std::string rough_time(double seconds);

// One line of it, without the time: "340 of 1,000 points, 2 failed, 45 points/s, about 15 s left".
std::string progress_text(const explore::RunStatus& status);

}  // namespace rastertlm::cli
