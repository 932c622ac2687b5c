// One function a kind of hard case: runs the machine's own core and returns what it measured.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "modules/object_processor/parameters.h"
#include "platforms/quadratic/machine.h"
#include "src/analysis/stability.h"

namespace rastertlm::analysis {

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

// Keeps the measurement that is nearest to its bound, or furthest beyond it.
void keep_worst(Measurement& worst, double measured, double bound);

std::vector<Measurement> measure_differences(const HardCase& c, const quadratic::Machine& machine, Numbers& numbers,
                                             std::int64_t tries);
std::vector<Measurement> measure_start_edge(const quadratic::Machine& machine, Numbers& numbers, std::int64_t tries);
std::vector<Measurement> measure_solver(const HardCase& c, const quadratic::Machine& machine, Numbers& numbers,
                                        std::int64_t tries);
std::vector<Measurement> measure_coverage(const HardCase& c, const quadratic::Machine& machine);
std::vector<Measurement> measure_linear_form(const object_processor::ObjectProcessorParameters& parameters,
                                             Numbers& numbers, std::int64_t tries);

}  // namespace rastertlm::analysis
