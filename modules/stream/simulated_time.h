// Cycles of a clock as SystemC time: counted as integers, converted once.
#pragma once

#include <systemc>

#include "src/base/units.h"

namespace rastertlm::stream {

inline sc_core::sc_time to_time(std::uint64_t picoseconds) {
  return sc_core::sc_time::from_value(
      picoseconds);  // the kernel's resolution is 1 ps (checked where the platform is built)
}

inline sc_core::sc_time to_time(const Clock& clock, Cycles cycles) { return to_time(clock.picoseconds(cycles)); }

inline std::uint64_t picoseconds_now() { return sc_core::sc_time_stamp().value(); }

// Lets time pass to `picoseconds`, if it has not come yet.
inline void wait_until(std::uint64_t picoseconds) {
  const std::uint64_t now = picoseconds_now();
  if (picoseconds > now) sc_core::wait(to_time(picoseconds - now));
}

}  // namespace rastertlm::stream
