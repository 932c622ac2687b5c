#include "modules/set_up/load_words.h"

#include <bit>

namespace rastertlm::set_up {

LoadWords& LoadWords::operator+=(const LoadWords& other) {
  lines += other.lines;
  columns += other.columns;
  rests += other.rests;
  colours += other.colours;
  depths += other.depths;
  return *this;
}

LoadWords load_words(const span_unit::TriangleLoad& load, bool linear) {
  constexpr LoadWords kEdge{0, 2, 3, 0, 0};
  constexpr LoadWords kLines{1, 0, 0, 0, 0};
  if (load.count == 0) return {};
  LoadWords words{1, 0, 0, span_unit::kChannels * (linear ? 3U : 6U), 3};  // the first line's number too
  words += kLines;
  words += kEdge;
  words += kEdge;
  if (load.count < 2) return words;
  words += kLines;
  words += kEdge;
  // Neither 2 T5 nor what a pixel adds to depth changes.
  if (!load.second_goes_on) words += {0, 0, 0, span_unit::kChannels * (linear ? 2U : 5U), 2};
  return words;
}

LoadWidths load_widths(std::uint64_t columns, std::uint64_t lines, unsigned corner_bits, unsigned colour_bits,
                       unsigned depth_bits) {
  const auto bits = [](std::uint64_t largest) { return static_cast<unsigned>(std::bit_width(largest)); };
  LoadWidths widths;
  widths.lines = bits(lines);
  widths.columns = 1 + bits(2 * columns);
  widths.rests = bits(3 * lines << 2 * corner_bits);
  widths.colours = colour_bits;
  widths.depths = depth_bits;
  return widths;
}

std::uint64_t bus_words(const LoadWords& words, const LoadWidths& widths, std::uint64_t bus_bits) {
  const auto crossing = [bus_bits](std::uint64_t count, unsigned width) {
    return count * ((width + bus_bits - 1) / bus_bits);
  };
  return crossing(words.lines, widths.lines) + crossing(words.columns, widths.columns) +
         crossing(words.rests, widths.rests) + crossing(words.colours, widths.colours) +
         crossing(words.depths, widths.depths);
}

}  // namespace rastertlm::set_up
