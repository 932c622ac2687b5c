// Runs a sweep: one thread, which makes no SystemC object and alone has the store, and a forked worker a simulation.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "src/explore/design.h"
#include "src/explore/store.h"
#include "src/explore/sweep.h"

namespace rastertlm::explore {

struct RunOptions {
  std::size_t jobs = 1;
  std::uint64_t shard = 0;   // the points whose number leaves this rest
  std::uint64_t shards = 1;  // divided by this
  bool retry = false;        // simulate again what failed
};

// How far a run is.
struct RunStatus {
  std::uint64_t points = 0;        // of the share
  std::uint64_t found = 0;         // of them, that had their result, or share one
  std::uint64_t simulated = 0;     // in this run
  std::uint64_t failed = 0;        // of the found and simulated
  std::uint64_t wrong = 0;         // of the failed, whose machine or scene has a bad value
  std::uint64_t first_failed = 0;  // the point of the lowest number that failed, if any did
  std::string first_error;         // why
  double seconds = 0.0;            // since the run began
  int signal = 0;                  // that stopped it; 0: none
};

// Simulates what the store lacks of the sweep. SIGINT and SIGTERM stop it, with everything recorded that had come.
// Throws InputError where the reports have no figure that an objective or a constraint asks for, and OutputError where
// the store or the system takes no more; what was recorded before stays.
RunStatus run_sweep(const Sweep& sweep, const Design& design, Store& store, const RunOptions& options,
                    const std::function<void(const RunStatus&)>& progress);

// What one point takes by itself, in seconds; nothing is recorded.
double time_of_a_point(const Sweep& sweep, const Design& design);

}  // namespace rastertlm::explore
