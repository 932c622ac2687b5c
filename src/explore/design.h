// Which points a sweep has: for each, which choice of every axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "src/explore/sweep.h"

namespace rastertlm::explore {

class Design {
 public:
  // Draws what is drawn: afterwards every axis of the sweep has its choices, in the order of a range's values.
  // Throws InputError for more than 10^12 points.
  explicit Design(Sweep& sweep);

  std::uint64_t size() const { return size_; }
  // A choice each axis of the sweep. In a grid the last axis varies fastest.
  std::vector<std::size_t> point(std::uint64_t number) const;
  std::optional<std::uint64_t> baseline() const { return baseline_; }

 private:
  void count_grid(const Sweep& sweep);
  void count_one_at_a_time(const Sweep& sweep);
  void draw(Sweep& sweep);
  void draw_axis(Sweep& sweep, std::size_t axis, std::vector<std::vector<std::size_t>>& drawn) const;

  Mode mode_;
  std::uint64_t size_ = 0;
  std::vector<std::size_t> sizes_;  // choices of each axis
  std::vector<std::size_t> start_;  // of the baseline
  std::optional<std::uint64_t> baseline_;
  std::vector<std::vector<std::size_t>> drawn_;  // an axis each: a choice each point
};

}  // namespace rastertlm::explore
