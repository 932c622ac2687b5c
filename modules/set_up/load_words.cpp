#include "modules/set_up/load_words.h"

#include <bit>

namespace rastertlm::set_up {

namespace {

struct Halves {
  LoadWords one;             // no second half
  LoadWords two;             // which begins with registers of its own
  LoadWords two_that_go_on;  // or goes on with the first's
};

constexpr Halves halves_of(bool linear) {
  constexpr LoadWords kEdge{0, 2, 3, 0, 0};
  constexpr LoadWords kLines{1, 0, 0, 0, 0};
  Halves halves;
  halves.one = {1, 0, 0, span_unit::kChannels * (linear ? 3U : 6U), 3};  // the first line's number too
  halves.one += kLines;
  halves.one += kEdge;
  halves.one += kEdge;
  halves.two_that_go_on = halves.one;
  halves.two_that_go_on += kLines;
  halves.two_that_go_on += kEdge;
  halves.two = halves.two_that_go_on;
  // Neither 2 T5 nor what a pixel adds to depth changes.
  halves.two += {0, 0, 0, span_unit::kChannels * (linear ? 2U : 5U), 2};
  return halves;
}

}  // namespace

LoadWords load_words(const span_unit::TriangleLoad& load, bool linear) {
  static constexpr Halves kLinear = halves_of(true), kQuadratic = halves_of(false);
  if (load.count == 0) return {};
  const Halves& halves = linear ? kLinear : kQuadratic;
  if (load.count < 2) return halves.one;
  return load.second_goes_on ? halves.two_that_go_on : halves.two;
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

BusCrossings::BusCrossings(const LoadWidths& widths, std::uint64_t bus_bits) {
  const auto crossing = [bus_bits](unsigned width) { return (width + bus_bits - 1) / bus_bits; };
  lines_ = crossing(widths.lines);
  columns_ = crossing(widths.columns);
  rests_ = crossing(widths.rests);
  colours_ = crossing(widths.colours);
  depths_ = crossing(widths.depths);
}

}  // namespace rastertlm::set_up
