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

BusBurst::BusBurst(const BusSchedule& schedule, std::span<const Segment> segments, Cycles word, Cycles start)
    : schedule_(schedule), segments_(segments), word_(word.count()), cycle_(start) {
  open_segment();
}

void BusBurst::open_segment() {
  if (done()) return;
  compute_ = segments_[segment_].compute;
  words_ = segments_[segment_].words;
  credit_ = 0;
}

// On to the next copy: what it finds are the words that ended before it began. A step ends where the bus comes to stand
// still, and where a copy has begun meanwhile.
BusBurst::Step BusBurst::step() {
  std::optional<Stall> coming = schedule_.next(cycle_);
  Cycles standing = cycle_;  // until when the bus stands still now
  if (coming && coming->begin <= cycle_) {
    standing = coming->end;
    coming = schedule_.next(standing);
  }
  Step step;
  Cycles now = cycle_;
  const auto end_at = [&](Cycles cycle) {
    step.busy = cycle - cycle_;
    cycle_ = cycle;
    return step;
  };
  for (; !done(); ++segment_, open_segment()) {
    now += compute_;
    compute_ = Cycles(0);
    if (coming && now > coming->visible) return end_at(now);
    if (needed() > 0 && now < standing) {
      if (now > cycle_) return end_at(now);
      step.blocked = standing - now;
      cycle_ = standing;
      return step;
    }
    if (!coming || now.count() + needed() <= coming->visible.count()) {
      now += Cycles(needed());
      step.words += words_;
      continue;
    }
    const std::uint64_t run = std::min(needed(), (coming->begin - now).count());
    const std::uint64_t ended = (credit_ + (coming->visible - now).count()) / word_;
    credit_ = credit_ + run - ended * word_;
    words_ -= ended;
    step.words += ended;
    return end_at(now + Cycles(run));
  }
  return end_at(now);
}

}  // namespace rastertlm::host
