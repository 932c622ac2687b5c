// What a span unit is (000/001, section 5 and figure 6): declared once, here.
#pragma once

#include <cstdint>
#include <string>

#include "src/base/errors.h"
#include "src/base/units.h"
#include "src/parameter/table.h"

namespace rastertlm::span_unit {

// How the registers of a line's first pixel follow the start edge, which is not on a pixel in general.
// lattice: from pixel to pixel; where the edge's column moves by one more than the whole part of its slope, a second
//   step is added ("carry"). No multiplier, no error but rounding.
// prestep: along the edge itself, and at every line the distance to the first pixel, with `prestep_bits`, is multiplied
//   in. Sums may wrap on the way to a result, products may not: a slope that the word does not hold as a signed number
//   (of slivers) makes pixels that are not the triangle's. Such loads are counted.
// published: along the edge itself, and what stands there is shown on the first pixel (000/001 to the letter).
enum class StartEdge { lattice, prestep, published };
// Where the second step of a carry is made: in a second rank of adders, or in one more clock.
enum class Carry { rank, clock };
// Several units: triangles are dealt to them in turn, or unit k draws the columns k, k + units ... of every triangle.
enum class Share { triangles, columns };

inline constexpr std::int64_t kIntegerBits = 10;    // of a colour word: sign, guard, 8 of the level
inline constexpr std::int64_t kDepthRegister = 32;  // bits of the widest

struct SpanUnitParameters {
  double clock_ns = 50.0;  // 000, section 6
  std::int64_t word_bits = 32;
  std::int64_t fraction_bits = 20;
  std::int64_t depth_bits = 24;          // as they are compared and stored
  std::int64_t depth_fraction_bits = 8;  // below them, in the unit's registers
  StartEdge start_edge = StartEdge::lattice;
  std::int64_t prestep_bits = 8;
  Carry carry = Carry::rank;
  std::int64_t pixel_cycles = 1;
  std::int64_t load_cycles = 1;
  std::int64_t line_change_cycles = 0;
  std::int64_t shadow_sets = 1;
  std::int64_t units = 1;
  Share share = Share::columns;

  // Paths "span_unit.clock_ns" ...
  void declare(parameter::Table& table);
  // Words that do not hold what they must.
  void check(const std::string& file, Diagnostics& diagnostics) const;

  Clock clock() const { return Clock::from_period_ns("span unit", clock_ns); }
};

// The most that a colour may be off after `steps` line and pixel steps in registers whose six constants were rounded to
// nearest, in levels: 2^-(fraction_bits + 1) (k^2 + k + 2) / 2. A proof, and attained (numerics: adversarial rounding).
double fraction_bound(std::int64_t fraction_bits, std::uint64_t steps);
// The same of a linear colour, or of depth in its units, three constants: 2^-(fraction_bits + 1) (k + 1).
double linear_fraction_bound(std::int64_t fraction_bits, std::uint64_t steps);

// Line and pixel steps of the longest iteration: lines, carries (lattice) and pixels, those included that are stepped
// over left of the screen, where triangles reach as far as the screen is wide.
std::uint64_t longest_iteration(const SpanUnitParameters& parameters, std::uint64_t columns, std::uint64_t lines);

}  // namespace rastertlm::span_unit
