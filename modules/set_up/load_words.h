// What a triangle's load is on the bus: words of five kinds, each as wide as the register that it goes to.
#pragma once

#include <cstdint>

#include "modules/span_unit/span_words.h"

namespace rastertlm::set_up {

struct LoadWords {
  std::uint64_t lines = 0;    // the first line's number, and how many a half has
  std::uint64_t columns = 0;  // of an edge: where it stands, and its whole columns a line
  std::uint64_t rests = 0;    // of an edge: what is left of a column, a line, and the divisor
  std::uint64_t colours = 0;
  std::uint64_t depths = 0;
  std::uint64_t total() const { return lines + columns + rests + colours + depths; }
  constexpr LoadWords& operator+=(const LoadWords& other) {
    lines += other.lines;
    columns += other.columns;
    rests += other.rests;
    colours += other.colours;
    depths += other.depths;
    return *this;
  }
  friend bool operator==(const LoadWords&, const LoadWords&) = default;
};

// Words that the host writes for a load. `linear`: the machine's second differences are wired to zero (Gouraud).
LoadWords load_words(const span_unit::TriangleLoad& load, bool linear);

// Bits of a word of each kind.
struct LoadWidths {
  unsigned lines = 0;
  unsigned columns = 0;
  unsigned rests = 0;
  unsigned colours = 0;
  unsigned depths = 0;
};

// What edges of triangles need that reach over a screen of `columns` x `lines` by its size on every side, corners in
// steps of 2^-corner_bits pixel. A column is signed and wraps; a rest is less than the divisor, an edge's height times
// 2^corner_bits.
LoadWidths load_widths(std::uint64_t columns, std::uint64_t lines, unsigned corner_bits, unsigned colour_bits,
                       unsigned depth_bits);

// A word that is wider than the bus crosses it in several: in how many, a kind.
class BusCrossings {
 public:
  BusCrossings(const LoadWidths& widths, std::uint64_t bus_bits);
  std::uint64_t of(const LoadWords& words) const {
    return words.lines * lines_ + words.columns * columns_ + words.rests * rests_ + words.colours * colours_ +
           words.depths * depths_;
  }

 private:
  std::uint64_t lines_, columns_, rests_, colours_, depths_;
};
inline std::uint64_t bus_words(const LoadWords& words, const LoadWidths& widths, std::uint64_t bus_bits) {
  return BusCrossings(widths, bus_bits).of(words);
}

}  // namespace rastertlm::set_up
