// Work in a process of its own, for libraries that a damaged input can stop, or keep busy for ever.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace rastertlm {

struct ChildLimits {
  double cpu_seconds = 10.0;
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;  // beyond what this process holds as it starts
};

enum class ChildEnd { done, stopped, out_of_time, out_of_memory };

struct ChildOutcome {
  ChildEnd end = ChildEnd::stopped;
  int signal = 0;     // of `stopped`: by which; 0: it left by itself, or threw
  std::string bytes;  // of `done`: what the work returned
};

// Forks, does the work there and waits for its bytes. Nothing else that the work does is seen here: its memory is its
// own, and what it prints is dropped. Throws std::system_error where no process can be had.
ChildOutcome in_child(const ChildLimits& limits, const std::function<std::string()>& work);

// Writes all of it, as far as the other end takes it.
void write_all(int descriptor, const std::string& bytes);

}  // namespace rastertlm
