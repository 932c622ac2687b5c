// Which slots of a board can touch a line: by bands of lines, so that a line asks only those of its band.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/object_processor/interval.h"

namespace rastertlm::object_processor {

class BandIndex {
 public:
  explicit BandIndex(std::uint32_t lines);  // of the screen; nothing touches it at first

  // `intervals`: the lines of each slot, [0, lines) or less.
  void sort(std::span<const Interval> intervals);

  // The slots that can touch a line of the line's band, in order of their numbers.
  std::span<const std::uint32_t> active(std::uint32_t line) const {
    const std::size_t band = line / kBandLines;
    return std::span(slots_).subspan(begin_[band], begin_[band + 1] - begin_[band]);
  }
  std::uint32_t touched_by(std::uint32_t line) const { return touched_by_[line]; }  // how many can touch it
  std::uint64_t words() const { return begin_.capacity() + slots_.capacity() + touched_by_.capacity(); }

 private:
  std::vector<std::uint32_t> begin_;  // bands + 1: where a band's slots stand in slots_
  std::vector<std::uint32_t> slots_;  // in order of their numbers within a band
  std::vector<std::uint32_t> touched_by_;
};

}  // namespace rastertlm::object_processor
