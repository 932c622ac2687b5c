// How the frame store's memory is laid out in words and banks, and how many accesses what is drawn, cleared and shown
// takes. Counts, no time.
#pragma once

#include <cstdint>

#include "modules/frame_store/parameters.h"

namespace rastertlm::frame_store {

// Depth (with the triangle's number where ties need it) and colour of a pixel lie side by side: pixels of a line in as
// few words as hold them whole, or a pixel in several words. Pixels that are accessed together, one word's or one, are
// a group; groups of a line are dealt to the banks in turn, and the banks work side by side. What a bank does for a
// span, a line or a clear is done when the busiest bank has done it.
struct MemoryLayout {
  std::uint64_t columns = 0;
  std::uint64_t lines = 0;
  // Of a pixel, in every buffer.
  std::uint64_t colour_bits = kColourBits;
  std::uint64_t depth_bits = 0;   // 0 where there is no test
  std::uint64_t number_bits = 0;  // of the triangle's number, where ties need it
  std::uint64_t buffers = 1;
  std::uint64_t pixels_a_word = 1;  // 1 where a pixel takes several words
  std::uint64_t depth_words = 1;    // read to test a group; 0 where there is no test
  std::uint64_t write_words = 1;    // written where a pixel of it wins
  std::uint64_t colour_words = 1;   // read to show it
  std::uint64_t banks = 1;

  static MemoryLayout of(const FrameStoreParameters& parameters, std::uint64_t columns, std::uint64_t lines,
                         unsigned depth_bits, bool ties);

  std::uint64_t pixel_bits() const { return colour_bits + depth_bits + number_bits; }

  // Where it matters which pixels of a span won, and not only how many.
  bool asks_which_won() const { return pixels_a_word > 1 || banks > 1; }

  // Accesses of the busiest bank for `count` pixels from `column` on, so many accesses each group.
  std::uint64_t accesses(std::uint64_t column, std::uint64_t count, std::uint64_t words_each) const;
  // Of a span, of which `kept` pixels won: all is read where there is a depth test, and what holds a pixel that won is
  // written. `won`: a bit a pixel, from the lowest on; needed where asks_which_won().
  std::uint64_t span_accesses(std::uint64_t column, std::uint64_t count, std::uint64_t kept,
                              const std::uint64_t* won) const;
  std::uint64_t line_accesses() const { return accesses(0, columns, colour_words); }
  std::uint64_t clear_accesses() const { return lines * accesses(0, columns, write_words); }

  // Words of a bank that a picture takes.
  std::uint64_t words_a_bank() const;
};

}  // namespace rastertlm::frame_store
