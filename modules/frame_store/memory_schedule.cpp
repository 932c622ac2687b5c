#include "modules/frame_store/memory_schedule.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace rastertlm::frame_store {
namespace {

std::uint64_t ceil_of(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

}  // namespace

MemoryLayout MemoryLayout::of(const FrameStoreParameters& parameters, std::uint64_t columns, std::uint64_t lines,
                              unsigned depth_bits, bool ties) {
  MemoryLayout layout;
  layout.columns = columns;
  layout.lines = lines;
  layout.banks = static_cast<std::uint64_t>(parameters.banks);
  const auto width = static_cast<std::uint64_t>(parameters.width_bits);
  const std::uint64_t tested = parameters.depth_test ? depth_bits + (ties ? kTieBits : 0U) : 0U;
  const std::uint64_t pixel = tested + kColourBits;
  layout.pixels_a_word = std::max<std::uint64_t>(width / pixel, 1);
  layout.depth_words = parameters.depth_test ? ceil_of(tested, width) : 0;
  layout.write_words = ceil_of(pixel, width);
  layout.colour_words = ceil_of(kColourBits, width);
  return layout;
}

std::uint64_t MemoryLayout::accesses(std::uint64_t column, std::uint64_t count, std::uint64_t words_each) const {
  if (count == 0) return 0;
  // Divisions are dear, and most machines need none.
  const std::uint64_t groups =
      pixels_a_word == 1 ? count : (column + count - 1) / pixels_a_word - column / pixels_a_word + 1;
  return (banks == 1 ? groups : ceil_of(groups, banks)) * words_each;
}

std::uint64_t MemoryLayout::span_accesses(std::uint64_t column, std::uint64_t count, std::uint64_t kept,
                                          bool depth_test) const {
  return (depth_test ? accesses(column, count, depth_words) : 0) + accesses(column, kept, write_words);
}

MemorySchedule::MemorySchedule(std::uint64_t access_ps, std::optional<video::Timing> timing, std::uint64_t lines,
                               std::uint64_t line_accesses)
    : access_ps_(access_ps),
      timing_(std::move(timing)),
      lines_(lines),
      burst_ps_(line_accesses * access_ps),
      next_burst_ps_(timing_ ? burst_begin(0) : std::numeric_limits<std::uint64_t>::max()) {}

std::uint64_t MemorySchedule::burst_begin(std::uint64_t number) const {
  const Cycles begins = timing_->frame * (number / lines_) + timing_->line_start(number % lines_);
  return timing_->clock.picoseconds(begins);
}

// A burst begins when it is due, or when what was before it ends.
std::uint64_t MemorySchedule::serve(std::uint64_t begin_ps, std::uint64_t accesses) {
  std::uint64_t now = std::max(begin_ps, free_ps_);
  std::uint64_t left = accesses;
  while (left > 0) {
    if (now < next_burst_ps_) {
      // The access during which the burst falls due ends first.
      const std::uint64_t before = std::min(left, (next_burst_ps_ - now - 1) / access_ps_ + 1);
      left -= before;
      now += before * access_ps_;
      free_ps_ = now;
      continue;
    }
    free_ps_ = std::max(next_burst_ps_, free_ps_) + burst_ps_;
    if (free_ps_ > now) {
      waited_ps_ += free_ps_ - now;
      now = free_ps_;
    }
    next_burst_ps_ = burst_begin(++next_burst_);
  }
  served_ps_ += accesses * access_ps_;
  return now;
}

}  // namespace rastertlm::frame_store
