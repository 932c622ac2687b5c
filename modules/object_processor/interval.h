// Columns or lines in a row.
#pragma once

#include <cstdint>

namespace rastertlm::object_processor {

inline constexpr std::uint32_t kBandLines = 8;  // lines whose spans are found together, from a multiple of it on

// Columns or lines [begin, end).
struct Interval {
  std::int32_t begin = 0;
  std::int32_t end = 0;
  bool empty() const { return begin >= end; }
  bool holds(std::int32_t position) const { return begin <= position && position < end; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

}  // namespace rastertlm::object_processor
