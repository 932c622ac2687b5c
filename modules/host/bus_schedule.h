// When the bus of an object board can take words: while the boards copy their loading RAMs it stands still, and a word
// that is on its way is stretched. Cycles are those of the host clock, counted from the retrace that started the
// update.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "src/base/units.h"

namespace rastertlm::host {

// When the boards copy. Retraces begin at multiples of `period` from the start of the simulation.
struct CopyTimes {
  Clock clock;                 // of the display
  Cycles period;               // from retrace to retrace
  Cycles duration;             // of a copy, from the start of its retrace
  bool every_retrace = false;  // or only at the retrace that started the update
};

struct Stall {
  Cycles begin;    // the first cycle that starts in the copy
  Cycles end;      // the first that starts after it
  Cycles visible;  // cycles that had ended when the copy began: what was written in them is copied
};

class BusSchedule {
 public:
  // Nothing is ever copied: before the first picture.
  explicit BusSchedule(const Clock& host) : host_(host) {}
  // `start_ps`: the retrace that started the update.
  BusSchedule(const Clock& host, const CopyTimes& copies, std::uint64_t start_ps)
      : host_(host), copies_(copies), start_ps_(start_ps) {}

  // The first stall that ends after `cycle`; none where no copy comes any more.
  std::optional<Stall> next(Cycles cycle) const;
  // Picoseconds since the start of the simulation.
  std::uint64_t picoseconds(Cycles cycle) const { return start_ps_ + host_.picoseconds(cycle); }

 private:
  Stall stall(std::uint64_t retrace) const;

  Clock host_;
  std::optional<CopyTimes> copies_;
  std::uint64_t start_ps_ = 0;
};

// Arithmetic, which no copy stops, and then words on the bus.
struct Segment {
  Cycles compute;
  std::uint64_t words = 0;
};

// Segments one after the other, cut where copies begin.
class BusBurst {
 public:
  // Words of `word` > 0 cycles each, from cycle `start` on. `schedule` and `segments` outlive the burst.
  BusBurst(const BusSchedule& schedule, std::span<const Segment> segments, Cycles word, Cycles start);

  struct Step {
    std::uint64_t words = 0;  // that stand in the loading RAM before the next copy begins
    Cycles busy;              // computing and writing; or
    Cycles blocked;           // the bus stands still
  };
  bool done() const { return segment_ == segments_.size(); }
  Step step();  // !done()
  Cycles cycle() const { return cycle_; }

 private:
  void open_segment();
  std::uint64_t needed() const { return words_ * word_ - credit_; }

  const BusSchedule& schedule_;
  std::span<const Segment> segments_;
  std::uint64_t word_;
  Cycles cycle_;
  std::size_t segment_ = 0;
  Cycles compute_;            // left of the segment
  std::uint64_t words_ = 0;   // likewise
  std::uint64_t credit_ = 0;  // cycles spent on words that are not yet counted
};

}  // namespace rastertlm::host
