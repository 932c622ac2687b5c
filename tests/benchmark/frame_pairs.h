// Times simulated frames and frames of the plain loop in turn, and compares their pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::benchmark {

struct Case {
  std::size_t triangles = 64;
  std::size_t processors = 1024;  // a multiple of eight
  double pixels = 1.5 * 512 * 512;
  std::size_t pairs = 30;
  bool plain = true;    // false: the simulation alone, for a profile or its memory
  bool errors = false;  // measure what figures of errors cost, and nothing else
  bool pipeline = false;
};

// Times in nanoseconds; medians over the pairs.
struct Measured {
  double simulated = 0.0;
  double plain = 0.0;
  double plain_set_up = 0.0;
  double plain_spans = 0.0;
  double plain_shading = 0.0;
  double levels = 0.0;   // the basic error figures of a finished frame against its finished exact picture
  double metrics = 0.0;  // all of them that are always reported: with edges of triangles and flicker
  std::uint64_t covered = 0;
  std::uint64_t visible = 0;
  std::uint64_t different_bytes = 0;  // of RGB, over all frames
  std::uint64_t frames_compared = 0;
  std::uint64_t repeated_frames = 0;  // shown again because the host was late: such a run measures nothing
  std::uint64_t peak_bytes = 0;       // resident, of the process
  double ratio() const { return simulated / plain; }
};

// Once a process: SystemC allows one simulation.
Measured measure(const Case& wanted);

// The same in a child process, and in another one the figures of errors: they need all that is known of pixels, which
// frames are not timed with.
Measured measure_apart(const Case& wanted);

}  // namespace rastertlm::benchmark
