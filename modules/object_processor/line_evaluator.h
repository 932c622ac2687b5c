// Closed forms of what the elementary processors step through: a word at any pixel, the span of a line inside three
// edges, the lines that a triangle can touch. Integers only; each equals the microprogram, wrapping included.
#pragma once

#include <array>
#include <cstdint>

#include "modules/object_processor/interval.h"
#include "modules/object_processor/triangle_processor.h"
#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {

// A word along a line, moved to the top of 32 bits: there the wrap of the word is that of the machine's integers, and
// its sign bit theirs. At column x it is start + x * step modulo 2^32.
struct LineWord {
  std::int32_t start = 0;
  std::int32_t step = 0;
};

class WordFormat {
 public:
  explicit constexpr WordFormat(unsigned bits) : bits_(bits), up_(32 - bits) {}  // 8..32
  constexpr unsigned bits() const { return bits_; }
  constexpr std::uint32_t mask() const { return static_cast<std::uint32_t>(low_mask(bits_)); }

  // A x + B (y + 1) + C modulo 2^bits.
  constexpr std::uint32_t at(const LinearWords& words, std::uint32_t column, std::uint32_t line) const {
    return (words.a * column + words.b * (line + 1) + words.c) & mask();
  }
  constexpr LineWord on_line(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t line) const {
    return {static_cast<std::int32_t>((b * (line + 1) + c) << up_), static_cast<std::int32_t>(a << up_)};
  }
  constexpr LineWord on_line(const LinearWords& words, std::uint32_t line) const {
    return on_line(words.a, words.b, words.c, line);
  }

 private:
  unsigned bits_;
  unsigned up_;
};

// Whether the word keeps its sign's meaning from column 0 to `last_column`: start + step * x stays inside the signed
// word.
constexpr bool stays_inside(const LineWord& word, std::int32_t last_column) {
  const std::int64_t last = std::int64_t{word.start} + std::int64_t{word.step} * last_column;
  return last == static_cast<std::int32_t>(last);
}

// Narrows `span` to the columns where a word that stays inside has sign bit 0. The quotients of 33-bit integers are
// taken in double: truncated they are exact, as a quotient that is no integer is 1 / divisor away from the next.
constexpr void narrow(const LineWord& word, Interval& span) {
  if (word.start < 0) {
    if (word.step <= 0) {
      span.end = span.begin;
      return;
    }
    const auto first = static_cast<std::int64_t>(
        (-static_cast<double>(word.start) + static_cast<double>(word.step) - 1.0) / static_cast<double>(word.step));
    if (first > span.begin) span.begin = first < span.end ? static_cast<std::int32_t>(first) : span.end;
  } else if (word.step < 0) {
    const auto end = static_cast<std::int64_t>(static_cast<double>(word.start) / -static_cast<double>(word.step)) + 1;
    if (end < span.end) span.end = static_cast<std::int32_t>(end);
  }
}

// An edge as an exact linear function of the pixel, a x + b y + c with y from 0, that stays inside the word on the
// whole screen.
struct HalfPlane {
  std::int64_t a = 0;
  std::int64_t b = 0;
  std::int64_t c = 0;
};
// Those of three edges that do; the others could wrap somewhere.
struct HalfPlanes {
  std::array<HalfPlane, 3> planes{};
  std::size_t count = 0;
};
HalfPlanes half_planes(const std::array<LinearWords, 3>& edges, WordFormat format, std::int32_t columns,
                       std::int32_t lines);
Interval touched_lines(const HalfPlanes& planes, WordFormat format, std::int32_t columns, std::int32_t lines);

// The lines of a screen on which the three edges may all have sign bit 0 somewhere: conservative, and never less. An
// edge that could wrap on the screen bounds nothing. `lines` and `columns` 1..16384.
Interval touched_lines(const std::array<LinearWords, 3>& edges, WordFormat format, std::int32_t columns,
                       std::int32_t lines);

// A line of words with the carry flip-flop on clock2 (an error of 004's text): the sums of B never carry; the first
// step along the line loses every carry and takes what is left over from the sum of B; later steps are right. So the
// line is linear from column 1 on.
struct LateCarryLine {
  std::uint32_t first = 0;  // the word of column 0
  std::uint32_t start = 0;  // the word of column x >= 1 is start + A x, modulo 2^word_bits
};
LateCarryLine late_carry_line(const LinearWords& words, const ObjectProcessorParameters& parameters,
                              std::uint32_t line);

}  // namespace rastertlm::object_processor
