// When the frame store's memory serves whom: accesses of spans one after the other, and where the screen is read
// through the same port, a burst at the start of every video line, which goes before them. An access that has begun
// ends. Integer picoseconds.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "modules/frame_store/memory_layout.h"
#include "modules/frame_store/parameters.h"
#include "modules/video/timing.h"

namespace rastertlm::frame_store {

class MemorySchedule {
 public:
  // `timing`: of the video whose lines are read through this port; none where it has its own.
  MemorySchedule(std::uint64_t access_ps, std::optional<video::Timing> timing, std::uint64_t lines,
                 std::uint64_t line_accesses);

  // Told when the memory served spans, or the screen.
  using Watcher = std::function<void(bool screen, std::uint64_t begin_ps, std::uint64_t end_ps)>;
  void watch(Watcher watcher) { watcher_ = std::move(watcher); }

  // The end of `accesses` that are asked for at `begin_ps`. Requests come in the order of their times.
  std::uint64_t serve(std::uint64_t begin_ps, std::uint64_t accesses);

  // So far: time that spans took, and that bursts kept them waiting.
  std::uint64_t served_ps() const { return served_ps_; }
  std::uint64_t waited_ps() const { return waited_ps_; }
  // Of a video frame.
  std::uint64_t scan_out_ps() const { return timing_ ? lines_ * burst_ps_ : 0; }
  // Bursts that have fallen due before then, since the start of the simulation.
  std::uint64_t bursts_before(std::uint64_t picoseconds) const;

 private:
  std::uint64_t burst_begin(std::uint64_t number) const;

  std::uint64_t access_ps_;
  std::optional<video::Timing> timing_;
  std::uint64_t lines_;
  std::uint64_t burst_ps_;
  std::uint64_t next_burst_ = 0;     // counted from the first line of the first video frame
  std::uint64_t next_burst_ps_ = 0;  // when it begins
  std::uint64_t free_ps_ = 0;
  std::uint64_t served_ps_ = 0;
  std::uint64_t waited_ps_ = 0;
  Watcher watcher_;
};

// A screen that is read through the port that is drawn through must leave something of it: a line's reads, and an
// access that has begun, take no longer than a line. Otherwise its lines would come late, and drawing would never be
// served.
void check_scan_out(const FrameStoreParameters& parameters, const MemoryLayout& layout, const video::Timing& timing,
                    const std::string& file, Diagnostics& diagnostics);

}  // namespace rastertlm::frame_store
