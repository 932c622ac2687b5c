// A link between two units: its width, its clock, and how much has crossed it. Bandwidth is computed here and nowhere
// else.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "src/base/units.h"

namespace rastertlm::stream {

class Link {
 public:
  // `bits` cross in parallel in each cycle of `clock`.
  Link(std::string name, unsigned bits, Clock clock) : name_(std::move(name)), bits_(bits), clock_(std::move(clock)) {}

  const std::string& name() const { return name_; }
  unsigned bits() const { return bits_; }
  const Clock& clock() const { return clock_; }

  // `words` of bits() each crossed in `active` cycles.
  void record(std::uint64_t words, Cycles active) {
    words_ += words;
    active_ += active;
  }
  void reset() {
    words_ = 0;
    active_ = Cycles(0);
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
  std::uint64_t words_ = 0;
  Cycles active_;
};

}  // namespace rastertlm::stream
