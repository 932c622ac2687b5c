#include "modules/frame_store/memory_limits.h"

#include <algorithm>
#include <bit>

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
      line_width_(as_double(layout.columns)),
      line_accesses_(as_double(layout.accesses(0, layout.columns, layout.depth_words + layout.write_words))) {}

double MemoryLimits::accesses(double complexity, double writes) const {
  return clear_ + complexity * reads_ + writes * writes_;
}

double MemoryLimits::drawing_share() const { return std::max(0.0, 1.0 - shown_ * access_seconds_ / frame_); }

double MemoryLimits::seconds(double accesses) const { return accesses * access_seconds_ / drawing_share(); }

double MemoryLimits::complexity_within(double seconds) const {
  const double accesses = seconds * drawing_share() / access_seconds_;
  return std::max(0.0, (accesses - clear_) / (reads_ + writes_));
}

// accesses t / (1 - shown t / frame) = seconds, for t.
double MemoryLimits::access_ns_within(double accesses, double seconds) const {
  return seconds / (accesses + shown_ * seconds / frame_) / kNanosecond;
}

double MemoryLimits::access_ns_of_pixel(double pixel_ns) const { return pixel_ns * line_width_ / line_accesses_; }

MemoryPins memory_pins(const FrameStoreParameters& parameters, const MemoryLayout& layout) {
  const std::uint64_t words = layout.words_a_bank() * static_cast<std::uint64_t>(parameters.buffers);
  const auto address = static_cast<std::uint64_t>(std::bit_width(words - 1));
  return {layout.banks * static_cast<std::uint64_t>(parameters.width_bits), layout.banks * address, layout.banks};
}

}  // namespace rastertlm::frame_store
