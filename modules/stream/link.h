// A link between two units: its width, its clock, and how much has crossed it. Bandwidth is computed here and nowhere
// else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "src/base/units.h"

namespace rastertlm::stream {

// Told of words that cross from one time to another, in picoseconds.
using LinkWatcher = std::function<void(std::uint64_t words, std::uint64_t begin_ps, std::uint64_t end_ps)>;

class Link {
 public:
  // `bits` cross in parallel in each cycle of `clock`.
  Link(std::string name, unsigned bits, Clock clock) : name_(std::move(name)), bits_(bits), clock_(std::move(clock)) {}

  const std::string& name() const { return name_; }
  unsigned bits() const { return bits_; }
  const Clock& clock() const { return clock_; }

  // Of what is recorded with its times.
  void watch(LinkWatcher watcher) { watcher_ = std::move(watcher); }

  // `words` of bits() each crossed in `active` cycles.
  void record(std::uint64_t words, Cycles active) {
    words_ += words;
    active_ += active;
  }
  // The same, spread evenly over the time from `begin_ps` to `end_ps`, which may not have come; such records follow
  // each other in time.
  void record(std::uint64_t words, Cycles active, std::uint64_t begin_ps, std::uint64_t end_ps) {
    record(words, active);
    if (watcher_) watcher_(words, begin_ps, end_ps);
    last_ = {words, active, begin_ps, end_ps};
  }
  // Counting starts at `now_ps`: of what is on its way, the rest counts.
  void reset(std::uint64_t now_ps) {
    words_ = last_.words_after(now_ps);
    active_ = last_.active_after(now_ps);
  }
  // As the link stands at `now_ps`: without what has not crossed by then.
  Link at(std::uint64_t now_ps) const {
    Link then = *this;
    then.words_ -= last_.words_after(now_ps);
    then.active_ = active_ - last_.active_after(now_ps);
    return then;
  }

  std::uint64_t words() const { return words_; }
  Cycles active() const { return active_; }
  // Bytes that crossed, to the last whole byte.
  std::uint64_t bytes() const { return words_ * bits_ / 8; }
  // One word a cycle.
  double peak_bytes_per_second() const { return clock_.frequency_hz() * bits_ / 8.0; }

 private:
  std::string name_;
  unsigned bits_;
  Clock clock_;
  // What was recorded last, as far as it may still be under way.
  struct Last {
    std::uint64_t words = 0;
    Cycles active;
    std::uint64_t begin_ps = 0;
    std::uint64_t end_ps = 0;
    std::uint64_t words_after(std::uint64_t now_ps) const { return after(words, now_ps); }
    Cycles active_after(std::uint64_t now_ps) const { return Cycles(after(active.count(), now_ps)); }

   private:
    // Rounded up: a word has crossed when its last bit has.
    std::uint64_t after(std::uint64_t count, std::uint64_t now_ps) const {
      if (now_ps >= end_ps) return 0;
      if (now_ps <= begin_ps) return count;
      const double left = static_cast<double>(end_ps - now_ps) / static_cast<double>(end_ps - begin_ps);
      return std::min(count, static_cast<std::uint64_t>(std::ceil(static_cast<double>(count) * left)));
    }
  };

  std::uint64_t words_ = 0;
  Cycles active_;
  Last last_;
  LinkWatcher watcher_;
};

}  // namespace rastertlm::stream
