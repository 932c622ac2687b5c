// What the simulation itself took.
#pragma once

#include <sys/resource.h>

#include <chrono>

#include "src/run/result.h"

namespace rastertlm::run {

using HostTime = std::chrono::steady_clock::duration;

inline double seconds_of(HostTime time) { return std::chrono::duration<double>(time).count(); }

// Of the simulation, of exact pictures and of the figures of errors.
inline HostFigures host_figures(HostTime passed, HostTime exact, HostTime figures, std::uint64_t simulated_clocks) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double seconds = seconds_of(passed);
  return {seconds, static_cast<double>(simulated_clocks) / seconds, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024,
          seconds_of(exact), seconds_of(figures)};
}

}  // namespace rastertlm::run
