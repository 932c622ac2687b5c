// What the words of a loading RAM mean, and what they are worth: for who reads them beside the geometry that they come
// from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rastertlm::analysis {

// Where the binary point of each kind of word stands: a word counts units of 2^-bits.
struct BinaryPoints {
  int edge = 0;         // an edge word is a signed area: pixel of distance times pixel of edge
  bool scaled = false;  // every edge has a scale of its own: its words are given as they are
  int depth = 0;        // as many units as the screen's longer side has pixels, rounded up to a power of two
  int normal = 0;       // a component of the normal, of length one at most
};

// For words of 8..32 bits on a screen of `columns` x `lines`; `snap_fraction_bits`: of the frame's snapped vertices.
BinaryPoints binary_points(unsigned word_bits, std::size_t columns, std::size_t lines, int snap_fraction_bits,
                           bool scaled);

struct WordWorth {
  std::string meaning;  // "edge 0 A", "depth C'", "normal x B", "material"
  double value = 0.0;   // exact
  std::string unit;
};

// `index`: of the word in its processor, as in triangle_processor.h. Slopes and constants are signed, but for the
// constant of depth.
WordWorth word_worth(const BinaryPoints& points, unsigned word_bits, std::size_t index, std::uint32_t word);

}  // namespace rastertlm::analysis
