// A scan line as the spans that objects cover, before anybody looks at a pixel of it: what a board's line holds, for as
// long as its pixels are of no interest to anybody.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rastertlm::frame {

// A word along a line: a x + b (line + 1) + c, modulo 2^word_bits.
struct WordPlane {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
};

// What an object processor shows wherever it covers a pixel.
struct alignas(64) FragmentSource {
  WordPlane depth;
  WordPlane normal[3];
  std::uint32_t material = 0;
  std::uint32_t object = 0;  // observer: from 1
};

// Columns [begin, end), not empty, that an object covers.
struct CoveredSpan {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  const FragmentSource* source = nullptr;
};

// Spans in the order of processor numbers; they are the board's.
struct CoveredLine {
  const CoveredSpan* spans = nullptr;
  std::size_t count = 0;
  std::uint64_t seen_pixels = 0;  // columns where an object is seen
};

}  // namespace rastertlm::frame
