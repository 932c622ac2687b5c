// Where a unit's cycles went. Every cycle is one of the four, and their sum is checked against the cycles that passed.
#pragma once

#include <cstdint>
#include <string>

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
    if (busy + starved + blocked + idle != cycles)
      throw ModelError(unit, cycles,
                       "busy " + std::to_string(busy) + " + starved " + std::to_string(starved) + " + blocked " + std::to_string(blocked) +
                           " + idle " + std::to_string(idle) + " is not " + std::to_string(cycles) + " cycles");
  }
};

}  // namespace rastertlm::stream
