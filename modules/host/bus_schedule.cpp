#include "modules/host/bus_schedule.h"

#include <algorithm>

namespace rastertlm::host {

Stall BusSchedule::stall(std::uint64_t retrace) const {
  const std::uint64_t begins = copies_->clock.picoseconds(copies_->period * retrace) - start_ps_;
  const std::uint64_t ends = copies_->clock.picoseconds(copies_->period * retrace + copies_->duration) - start_ps_;
  return {host_.cycles_at(begins), host_.cycles_at(ends), host_.cycles_at(begins + 1) - Cycles(1)};
}

std::optional<Stall> BusSchedule::next(Cycles cycle) const {
  if (!copies_) return std::nullopt;
  const std::uint64_t first = copies_->clock.cycles_at(start_ps_).count() / copies_->period.count();
  if (!copies_->every_retrace) {
    const Stall only = stall(first);
    return only.end > cycle ? std::optional(only) : std::nullopt;
  }
  // The retrace before this cycle may still be copying.
  const std::uint64_t passed = copies_->clock.cycles_at(picoseconds(cycle)).count() / copies_->period.count();
  for (std::uint64_t retrace = passed > first ? passed - 1 : first;; ++retrace)
    if (const Stall one = stall(retrace); one.end > cycle) return one;
}

BusBurst::Step BusBurst::step() {
  const std::uint64_t needed = remaining_ * word_ - credit_;
  Step step;
  if (needed == 0) {
    step.words = remaining_;
    remaining_ = 0;
    return step;
  }
  const std::optional<Stall> stall = schedule_.next(cycle_);
  if (stall && stall->begin <= cycle_) {
    step.blocked = stall->end - cycle_;
    cycle_ = stall->end;
    return step;
  }
  if (!stall || cycle_.count() + needed <= stall->visible.count()) {
    step = {remaining_, Cycles(needed), Cycles(0)};
    remaining_ = 0;
    cycle_ += step.busy;
    return step;
  }
  step.busy = Cycles(std::min(needed, (stall->begin - cycle_).count()));
  const std::uint64_t visible = stall->visible > cycle_ ? (stall->visible - cycle_).count() : 0;
  step.words = (credit_ + visible) / word_;
  remaining_ -= step.words;
  credit_ = credit_ + step.busy.count() - step.words * word_;
  cycle_ += step.busy;
  return step;
}

}  // namespace rastertlm::host
