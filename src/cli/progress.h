// How far a run is, for who watches it.
#pragma once

#include <chrono>
#include <cstdint>

namespace rastertlm::cli {

// Frames done and the time that is left, on standard error where that is a terminal; nothing elsewhere.
class Progress {
 public:
  explicit Progress(std::uint64_t frames);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void frame_done();

 private:
  std::uint64_t frames_;
  std::uint64_t done_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace rastertlm::cli
