// When the frame store's memory serves whom: accesses of spans one after the other, and where the screen is read
// through the same port, a burst at the start of every video line, which goes before them. An access that has begun
// ends. Integer picoseconds.
#pragma once

#include <cstdint>
#include <optional>

#include "modules/frame_store/parameters.h"
#include "modules/video/timing.h"

namespace rastertlm::frame_store {

// How pixels are laid out in words: depth and colour of a pixel side by side, pixels of a line in as few words as hold
// them whole, or a pixel in several words; words of a line are dealt to the banks in turn.
struct MemoryLayout {
  std::uint64_t columns = 0;
  std::uint64_t lines = 0;
  std::uint64_t pixels_a_word = 1;  // 1 where a pixel takes several words
  std::uint64_t depth_words = 1;    // read to test a pixel, or a word's pixels
  std::uint64_t write_words = 1;    // written where one wins
  std::uint64_t colour_words = 1;   // read to show it
  std::uint64_t banks = 1;

  static MemoryLayout of(const FrameStoreParameters& parameters, std::uint64_t columns, std::uint64_t lines,
                         unsigned depth_bits, bool ties);

  // Accesses of the busiest bank for `count` pixels from `column` on, so many accesses each word.
  std::uint64_t accesses(std::uint64_t column, std::uint64_t count, std::uint64_t words_each) const;
  // Of a span: everything is read where there is a depth test, and what holds a pixel that won is written. `kept`
  // pixels that won are taken to lie together.
  std::uint64_t span_accesses(std::uint64_t column, std::uint64_t count, std::uint64_t kept, bool depth_test) const;
  std::uint64_t line_accesses() const { return accesses(0, columns, colour_words); }
  std::uint64_t clear_accesses() const { return lines * accesses(0, columns, write_words); }
};

class MemorySchedule {
 public:
  // `timing`: of the video whose lines are read through this port; none where it has its own.
  MemorySchedule(std::uint64_t access_ps, std::optional<video::Timing> timing, std::uint64_t lines,
                 std::uint64_t line_accesses);

  // The end of `accesses` that are asked for at `begin_ps`. Requests come in the order of their times.
  std::uint64_t serve(std::uint64_t begin_ps, std::uint64_t accesses);

  // So far: time that spans took, and that bursts kept them waiting.
  std::uint64_t served_ps() const { return served_ps_; }
  std::uint64_t waited_ps() const { return waited_ps_; }
  // Of a video frame.
  std::uint64_t scan_out_ps() const { return timing_ ? lines_ * burst_ps_ : 0; }

 private:
  std::uint64_t burst_begin(std::uint64_t number) const;

  std::uint64_t access_ps_;
  std::optional<video::Timing> timing_;
  std::uint64_t lines_;
  std::uint64_t burst_ps_;
  std::uint64_t next_burst_ = 0;     // counted from the first line of the first video frame
  std::uint64_t next_burst_ps_ = 0;  // when it begins
  std::uint64_t free_ps_ = 0;
  std::uint64_t served_ps_ = 0;
  std::uint64_t waited_ps_ = 0;
};

}  // namespace rastertlm::frame_store
