#include "modules/frame_store/memory_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace rastertlm::frame_store {
MemorySchedule::MemorySchedule(std::uint64_t access_ps, std::optional<video::Timing> timing, std::uint64_t lines,
                               std::uint64_t line_accesses)
    : access_ps_(access_ps),
      timing_(std::move(timing)),
      lines_(lines),
      burst_ps_(line_accesses * access_ps),
      next_burst_ps_(timing_ ? burst_begin(0) : std::numeric_limits<std::uint64_t>::max()) {}

std::uint64_t MemorySchedule::bursts_before(std::uint64_t picoseconds) const {
  if (!timing_) return 0;
  const std::uint64_t clocks = timing_->clock.cycles_at(picoseconds).count();
  const std::uint64_t frame = timing_->frame.count();
  const std::uint64_t within = clocks % frame;
  const std::uint64_t retrace = timing_->vertical_retrace.count();
  const std::uint64_t line = timing_->line.count();
  const std::uint64_t begun = within <= retrace ? 0 : (within - retrace + line - 1) / line;
  return clocks / frame * lines_ + std::min(lines_, begun);
}

std::uint64_t MemorySchedule::burst_begin(std::uint64_t number) const {
  const Cycles begins = timing_->frame * (number / lines_) + timing_->line_start(number % lines_);
  return timing_->clock.picoseconds(begins);
}

// A burst begins when it is due, or when what was before it ends.
std::uint64_t MemorySchedule::serve(std::uint64_t begin_ps, std::uint64_t accesses) {
  std::uint64_t now = std::max(begin_ps, free_ps_);
  std::uint64_t left = accesses;
  while (left > 0) {
    if (now < next_burst_ps_) {
      // The access during which the burst falls due ends first.
      const std::uint64_t before = std::min(left, (next_burst_ps_ - now - 1) / access_ps_ + 1);
      left -= before;
      if (watcher_) watcher_(false, now, now + before * access_ps_);
      now += before * access_ps_;
      free_ps_ = now;
      continue;
    }
    const std::uint64_t begun = std::max(next_burst_ps_, free_ps_);
    free_ps_ = begun + burst_ps_;
    if (watcher_) watcher_(true, begun, free_ps_);
    if (free_ps_ > now) {
      waited_ps_ += free_ps_ - now;
      now = free_ps_;
    }
    next_burst_ps_ = burst_begin(++next_burst_);
  }
  served_ps_ += accesses * access_ps_;
  return now;
}

void check_scan_out(const FrameStoreParameters& parameters, const MemoryLayout& layout, const video::Timing& timing,
                    const std::string& file, Diagnostics& diagnostics) {
  if (parameters.scan_out == ScanOut::separate) return;
  const std::uint64_t accesses = layout.line_accesses() + 1;  // one may have begun when the burst is due
  const std::uint64_t line_ps = timing.clock.picoseconds(timing.line);
  if (accesses * parameters.access_ps() <= line_ps) return;
  constexpr double kNanosecond = 1e-3;
  diagnostics.add(
      {file, 0, "frame_store.scan_out",
       fmt::format("a line of the screen asks for {} accesses of {} ns through the shared port, and one may "
                   "be under way; a video line takes {:.6g} ns; at most {:.6g} ns an access would do, or "
                   "wider words, more banks, or \"separate\"",
                   accesses - 1, parameters.access_ns, static_cast<double>(line_ps) * kNanosecond,
                   static_cast<double>(line_ps / accesses) * kNanosecond)});
}

}  // namespace rastertlm::frame_store
