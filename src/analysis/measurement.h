// What a hard case finds: the worst error that was seen of a step, beside what is proved or required of it.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "src/report/stability_report.h"

namespace rastertlm::analysis {

using report::BoundKind;
using report::Measurement;

// Keeps the measurement that is nearest to its bound, or furthest beyond it.
void keep_worst(Measurement& worst, double measured, double bound);
// Keeps the largest error beside the bound of that very input, or what is furthest beyond its bound: for bounds that
// errors meet exactly, as those of single table entries.
void keep_largest(Measurement& worst, double measured, double bound);

// Nothing at all where the machine has no such step.
struct Measured {
  std::vector<Measurement> measurements;
  std::vector<std::string> notes;  // what a reader must know beside the figures: a sentence each
  // Where a measurement does not say on how many inputs its bound was checked, it was on all that were tried, which all
  // share; or each has inputs of its own.
  bool inputs_apart = false;
  bool empty() const { return measurements.empty() && notes.empty(); }
};

// Numbers that depend on the seed alone, not on a library's distributions.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) / 9007199254740992.0);  // 2^53
  }
  std::int64_t whole(std::int64_t low, std::int64_t high) {  // both included
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace rastertlm::analysis
