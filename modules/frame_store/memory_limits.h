// What a memory can serve, in closed form: for budgets. Screens are drawn in whole lines; short spans that begin or end
// within a word, or in the midst of banks, take more. Tested against the schedule.
#pragma once

#include <cstdint>

#include "modules/frame_store/memory_layout.h"
#include "modules/frame_store/parameters.h"
#include "modules/video/timing.h"

namespace rastertlm::frame_store {

class MemoryLimits {
 public:
  MemoryLimits(const FrameStoreParameters& parameters, const MemoryLayout& layout, const video::Timing& timing);

  // Accesses of the busiest bank in a frame: its clear, `complexity` screens of pixels tested, `writes` screens of them
  // won. Nearer ones first writes 1; in the order of nothing, 1 + 1/2 + ... + 1/complexity; without a test, complexity.
  double accesses(double complexity, double writes) const;
  // The part of its time that the memory has for drawing: all, or what bursts of the screen's reads leave.
  double drawing_share() const;
  // Seconds that so many accesses take, bursts between them included: from a retrace on where frames are swapped there,
  // whose time no burst disturbs; else from anywhere, bursts spread evenly.
  double seconds(double accesses) const;
  // The accesses that so many seconds hold.
  double accesses_within(double seconds) const;
  // The most screens of pixels that fit `seconds`, with all of them won; the clear not counted in. 0 where not even
  // that fits.
  double complexity_within(double seconds) const;
  // The slowest access with which so many accesses fit `seconds`, in nanoseconds.
  double access_ns_within(double accesses, double seconds) const;
  // The slowest access that keeps up with a span unit that takes `pixel_ns` for each pixel of a line all of which win,
  // in nanoseconds. Bursts apart.
  double access_ns_of_pixel(double pixel_ns) const;

 private:
  double shown_within(double seconds) const;

  double access_seconds_;
  double clear_;       // accesses
  double reads_;       // of a screen, to test it
  double writes_;      // of a screen
  double shown_;       // of a screen, through the port that is drawn through
  double frame_;       // seconds of a video frame
  double quiet_;       // of them, without a burst before the first one
  double line_width_;  // pixels
  double line_accesses_;
};

// Pins between the span unit and the memory: each bank its data, the address of its words, and whether it is written.
struct MemoryPins {
  std::uint64_t data = 0;
  std::uint64_t address = 0;
  std::uint64_t control = 0;
  std::uint64_t all() const { return data + address + control; }
};
MemoryPins memory_pins(const FrameStoreParameters& parameters, const MemoryLayout& layout);

}  // namespace rastertlm::frame_store
