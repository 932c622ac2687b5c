// What the words of an object processor mean to the host that computes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/object_processor/triangle_processor.h"
#include "src/base/fixed_point.h"

namespace rastertlm::set_up {

using object_processor::EdgeForm;
using object_processor::LinearWords;

struct WordFormat {
  int word_bits = 24;  // of a coefficient, 8..32
  std::size_t columns = 512;
  std::size_t lines = 512;
  EdgeForm edges = EdgeForm::snapped;
};

// Depth words are unsigned. Near and far keep this distance from the ends of the range, because a rounded plane may
// leave the values of its corners by half a unit for each pixel from its anchor.
constexpr std::int64_t depth_margin(const WordFormat& format) {
  return static_cast<std::int64_t>((format.columns + format.lines + 3) / 4) + 1;
}
constexpr std::int64_t near_depth(const WordFormat& format) { return depth_margin(format); }
constexpr std::int64_t far_depth(const WordFormat& format) {
  return (std::int64_t{1} << format.word_bits) - 2 - depth_margin(format);
}

// A normal's component 1.0 in units of its word: 22 fraction bits of 24, which leave a sign and a guard bit.
constexpr std::int64_t normal_unit(const WordFormat& format) { return std::int64_t{1} << (format.word_bits - 2); }

// The words of an EP1 that shows a x + b y + c on column x and line y, both from 0, modulo 2^word_bits. It adds B
// before its first line is shown, line y has b (y + 1) + C: the host loads C = c - b.
constexpr LinearWords loaded_words(std::int64_t a, std::int64_t b, std::int64_t c, int word_bits) {
  const auto word = [mask = low_mask(static_cast<unsigned>(word_bits))](std::uint64_t value) {
    return static_cast<std::uint32_t>(value & mask);
  };
  return {word(static_cast<std::uint64_t>(a)), word(static_cast<std::uint64_t>(b)),
          word(static_cast<std::uint64_t>(c) - static_cast<std::uint64_t>(b))};
}

}  // namespace rastertlm::set_up
