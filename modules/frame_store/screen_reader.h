// The screens that show frames while the store goes on: each is read line by line, a whole line at the start of its
// blanking, as the store then stands. A frame's screen is the first that begins when the frame is whole; what is drawn
// or swapped in before a line is read is seen on that line. Knows no SystemC.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "modules/frame_store/frame_store.h"
#include "modules/video/timing.h"
#include "src/frame/scan_line.h"

namespace rastertlm::frame_store {

class ScreenReader {
 public:
  struct Line {
    std::uint64_t frame = 0;  // whose screen it is
    std::uint32_t number = 0;
    std::uint64_t first_pixel_ps = 0;
    // Lines of this screen so far, this one included, whose levels are not those of the frame when it was whole.
    std::uint64_t torn_lines = 0;
  };
  // Called for every line of a frame's screen, in order; of frames that share a screen, for each.
  using Sink = std::function<void(const Line& line, const frame::RgbLine& levels)>;

  // `store` outlives it.
  ScreenReader(FrameStore& store, const video::Timing& timing, std::uint32_t columns, std::uint32_t lines, Sink sink);

  // The frame that is shown now is whole, and its screen begins then: at a retrace, not before an earlier frame's.
  void expect(std::uint64_t frame, std::uint64_t begin_ps);
  // The store is about to change: lines that are read until then, that instant included, are read first.
  void advance(std::uint64_t until_ps);
  // What is still to be read is read as the store stands.
  void finish();

 private:
  struct Screen {
    std::uint64_t frame = 0;
    std::uint64_t begin_ps = 0;
    std::uint64_t torn_lines = 0;
    std::vector<std::uint8_t> whole;  // levels of the frame when it was
  };
  std::uint64_t due_ps() const;  // of the next line
  void read_line();

  FrameStore& store_;
  video::Timing timing_;
  std::uint32_t lines_;
  Sink sink_;
  frame::RgbLine rgb_;
  std::deque<Screen> screens_;  // the first ones, which begin together, are being read
  std::uint32_t next_line_ = 0;
};

}  // namespace rastertlm::frame_store
