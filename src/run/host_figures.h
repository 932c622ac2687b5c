// What the simulation itself took.
#pragma once

#include <sys/resource.h>

#include <chrono>

#include "src/run/result.h"

namespace rastertlm::run {

inline HostFigures host_figures(std::chrono::steady_clock::duration passed, std::uint64_t simulated_clocks) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double seconds = std::chrono::duration<double>(passed).count();
  return {seconds, static_cast<double>(simulated_clocks) / seconds, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

}  // namespace rastertlm::run
