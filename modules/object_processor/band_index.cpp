#include "modules/object_processor/band_index.h"

#include <algorithm>

namespace rastertlm::object_processor {

BandIndex::BandIndex(std::uint32_t lines)
    : begin_(std::size_t{(lines + kBandLines - 1) / kBandLines} + 1, 0), touched_by_(std::size_t{lines} + 1, 0) {}

// A counting sort: by band, and in the order of numbers within one.
void BandIndex::sort(std::span<const Interval> intervals) {
  std::fill(touched_by_.begin(), touched_by_.end(), 0U);
  std::fill(begin_.begin(), begin_.end(), 0U);
  const auto first_band = [](const Interval& lines) { return static_cast<std::size_t>(lines.begin) / kBandLines; };
  const auto end_band = [](const Interval& lines) {
    return (static_cast<std::size_t>(lines.end) - 1) / kBandLines + 1;
  };
  for (const Interval& lines : intervals) {
    if (lines.empty()) continue;
    // Modulo 2^32: sums from the first line on are right.
    ++touched_by_[static_cast<std::size_t>(lines.begin)];
    --touched_by_[static_cast<std::size_t>(lines.end)];
    ++begin_[first_band(lines)];
    --begin_[end_band(lines)];
  }
  for (std::size_t line = 0; line + 1 < touched_by_.size(); ++line) touched_by_[line + 1] += touched_by_[line];
  std::uint32_t in_band = 0;
  std::uint32_t before = 0;
  for (std::uint32_t& begin : begin_) {
    in_band += begin;
    begin = before;
    before += in_band;
  }
  slots_.resize(before);
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t slot = 0; slot < intervals.size(); ++slot) {
    const Interval& lines = intervals[slot];
    if (lines.empty()) continue;
    for (std::size_t band = first_band(lines); band < end_band(lines); ++band) slots_[next[band]++] = slot;
  }
}

}  // namespace rastertlm::object_processor
