#include "modules/frame_store/memory_limits.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rastertlm::frame_store {
namespace {

constexpr double kNanosecond = 1e-9;

double as_double(std::uint64_t count) { return static_cast<double>(count); }

}  // namespace

MemoryLimits::MemoryLimits(const FrameStoreParameters& parameters, const MemoryLayout& layout,
                           const video::Timing& timing)
    : access_seconds_(parameters.access_ns * kNanosecond),
      clear_(parameters.clear ? as_double(layout.clear_accesses()) : 0.0),
      reads_(as_double(layout.lines * layout.accesses(0, layout.columns, layout.depth_words))),
      writes_(as_double(layout.lines * layout.accesses(0, layout.columns, layout.write_words))),
      shown_(parameters.scan_out == ScanOut::shared ? as_double(layout.lines * layout.line_accesses()) : 0.0),
      frame_(timing.clock.seconds(timing.frame)),
      quiet_(parameters.swap == Swap::retrace ? timing.clock.seconds(timing.vertical_retrace) : 0.0),
      line_width_(as_double(layout.columns)),
      line_accesses_(as_double(layout.accesses(0, layout.columns, layout.depth_words + layout.write_words))) {}

double MemoryLimits::accesses(double complexity, double writes) const {
  return clear_ + complexity * reads_ + writes * writes_;
}

double MemoryLimits::drawing_share() const { return std::max(0.0, 1.0 - shown_ * access_seconds_ / frame_); }

// Whole video frames, then a rest of one: first what no burst disturbs, then the lines.
double MemoryLimits::seconds(double accesses) const {
  const double lines = frame_ - quiet_;
  const double bursts = shown_ * access_seconds_;
  const double free = frame_ - bursts;  // of a video frame
  const double needed = accesses * access_seconds_;
  const double frames = free > 0.0 ? std::floor(needed / free) : 0.0;
  const double rest = needed - frames * free;
  return frames * frame_ + std::min(rest, quiet_) + std::max(0.0, rest - quiet_) / (1.0 - bursts / lines);
}

// Of the accesses that show screens, those that come in so many seconds.
double MemoryLimits::shown_within(double seconds) const {
  const double frames = std::floor(seconds / frame_);
  const double rest = seconds - frames * frame_;
  return shown_ * (frames + std::max(0.0, rest - quiet_) / (frame_ - quiet_));
}

double MemoryLimits::accesses_within(double seconds) const { return seconds / access_seconds_ - shown_within(seconds); }

double MemoryLimits::complexity_within(double seconds) const {
  return std::max(0.0, (accesses_within(seconds) - clear_) / (reads_ + writes_));
}

double MemoryLimits::access_ns_within(double accesses, double seconds) const {
  return seconds / (accesses + shown_within(seconds)) / kNanosecond;
}

double MemoryLimits::access_ns_of_pixel(double pixel_ns) const { return pixel_ns * line_width_ / line_accesses_; }

MemoryPins memory_pins(const FrameStoreParameters& parameters, const MemoryLayout& layout) {
  const std::uint64_t words = layout.words_a_bank() * static_cast<std::uint64_t>(parameters.buffers);
  const auto address = static_cast<std::uint64_t>(std::bit_width(words - 1));
  return {layout.banks * static_cast<std::uint64_t>(parameters.width_bits), layout.banks * address, layout.banks};
}

}  // namespace rastertlm::frame_store
