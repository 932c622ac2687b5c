// Where a unit's cycles went. Every cycle is one of the four, and their sum is checked against the cycles that passed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "src/base/errors.h"
#include "src/base/units.h"

namespace rastertlm::stream {

struct Occupancy {
  std::uint64_t cycles = 0;   // all that passed
  std::uint64_t busy = 0;     // working
  std::uint64_t starved = 0;  // waiting for something to work on
  std::uint64_t blocked = 0;  // waiting for a place to put it, or for a link or bus
  std::uint64_t idle = 0;     // nothing to do

  void check(const std::string& unit) const {
    const bool within = busy <= cycles && starved <= cycles && blocked <= cycles && idle <= cycles;  // no sum wraps
    if (!within || busy + starved + blocked + idle != cycles)
      throw ModelError(unit, cycles,
                       "busy " + std::to_string(busy) + " + starved " + std::to_string(starved) + " + blocked " +
                           std::to_string(blocked) + " + idle " + std::to_string(idle) + " is not " +
                           std::to_string(cycles) + " cycles");
  }
};

enum class Activity { busy, starved, blocked, idle };

// Told what was done from one time to another, in picoseconds, when it has ended.
using ActivityWatcher = std::function<void(Activity activity, std::uint64_t begin_ps, std::uint64_t end_ps)>;

// Follows one unit through simulated time and counts the cycles of its clock in each activity. A cycle belongs to the
// activity during which it begins, so the four always add up.
class OccupancyMeter {
 public:
  explicit OccupancyMeter(Clock clock) : clock_(std::move(clock)) {}

  void watch(ActivityWatcher watcher) { watcher_ = std::move(watcher); }

  // From `picoseconds` on, the unit does `activity`.
  void enter(Activity activity, std::uint64_t picoseconds) {
    tell(picoseconds);
    settle(picoseconds);
    activity_ = activity;
  }
  // Counting starts here: what was before is the initial load.
  void restart(std::uint64_t picoseconds) {
    occupancy_ = {};
    since_ = clock_.cycles_at(picoseconds).count();
    entered_ps_ = picoseconds;
  }
  const Occupancy& close(std::uint64_t picoseconds) {
    tell(picoseconds);
    settle(picoseconds);
    return occupancy_;
  }
  const Clock& clock() const { return clock_; }

 private:
  void tell(std::uint64_t picoseconds) {
    if (watcher_ && picoseconds > entered_ps_) watcher_(activity_, entered_ps_, picoseconds);
    entered_ps_ = std::max(picoseconds, entered_ps_);
  }
  void settle(std::uint64_t picoseconds) {
    // The end of a run may be rounded to a picosecond before the last transition: no time has passed then.
    const std::uint64_t now = std::max(clock_.cycles_at(picoseconds).count(), since_);
    const std::uint64_t passed = now - since_;
    since_ = now;
    occupancy_.cycles += passed;
    switch (activity_) {
      case Activity::busy:
        occupancy_.busy += passed;
        break;
      case Activity::starved:
        occupancy_.starved += passed;
        break;
      case Activity::blocked:
        occupancy_.blocked += passed;
        break;
      case Activity::idle:
        occupancy_.idle += passed;
        break;
    }
  }

  Clock clock_;
  Occupancy occupancy_;
  Activity activity_ = Activity::idle;
  std::uint64_t since_ = 0;
  ActivityWatcher watcher_;
  std::uint64_t entered_ps_ = 0;
};

}  // namespace rastertlm::stream
