// When the bus of an object board can take words: while the boards copy their loading RAMs it stands still, and a word
// that is on its way is stretched. Cycles are those of the host clock, counted from the retrace that started the
// update.
#pragma once

#include <cstdint>
#include <optional>

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

// A run of words on the bus, cut where copies begin.
class BusBurst {
 public:
  // Of `words`, each of `word` cycles, from cycle `start` on.
  BusBurst(const BusSchedule& schedule, std::uint64_t words, Cycles word, Cycles start)
      : schedule_(schedule), remaining_(words), word_(word.count()), cycle_(start) {}

  struct Step {
    std::uint64_t words = 0;  // that stand in the loading RAM before the next copy begins
    Cycles busy;              // the bus moves for so long,
    Cycles blocked;           // and then stands still
  };
  bool done() const { return remaining_ == 0; }
  Step step();  // !done()
  Cycles cycle() const { return cycle_; }

 private:
  const BusSchedule& schedule_;
  std::uint64_t remaining_;
  std::uint64_t word_;
  Cycles cycle_;
  std::uint64_t credit_ = 0;  // cycles spent on words that are not yet counted
};

}  // namespace rastertlm::host
