// Lines become a frame: levels as the screen shows them, and the observers' planes beside them.
#pragma once

#include <cstdint>

#include "src/frame/frame.h"
#include "src/frame/scan_line.h"

namespace rastertlm::video {

class FrameAssembly {
 public:
  struct Format {
    std::size_t columns = 0;
    std::size_t lines = 0;
    std::size_t fields = 1;     // 2: even lines, then odd ones, are woven into a frame
    unsigned normal_bits = 12;  // of a normal word: a sign bit above a one's complement magnitude
    std::uint32_t background_depth = 0xFFFFFF;
    bool observe = true;  // false: only the levels are kept
  };

  explicit FrameAssembly(const Format& format);

  // Lines may come in any order; each line of a frame comes once.
  void add_line(std::size_t line, const frame::RgbLine& rgb, const frame::FragmentLine& fragments);
  // Whether line `line` was the last of its field, and of which: 0 or 1. A frame that is not interlaced is one field.
  bool ends_field(std::size_t line) const { return line + format_.fields >= format_.lines; }
  std::size_t field(std::size_t line) const { return line % format_.fields; }
  const frame::Frame& frame() const { return frame_; }

 private:
  void observe(std::size_t line, const frame::FragmentLine& fragments);

  Format format_;
  frame::Frame frame_;
};

}  // namespace rastertlm::video
