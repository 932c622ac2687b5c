// From a coloured triangle to the loads of a span unit (000/001, section 5): its two horizontal-sided halves, their
// edges as integers, and the registers at the first pixel of each.
#pragma once

#include <array>
#include <cstdint>

#include "modules/set_up/quadratic_form.h"
#include "modules/span_unit/parameters.h"
#include "modules/span_unit/span_words.h"
#include "src/base/vector_variant.h"
#include "src/geometry/counted.h"
#include "src/geometry/snapping.h"

namespace rastertlm::pixel_unit {
struct PixelTriangle;
}

namespace rastertlm::set_up {

// What the span unit is to draw.
struct ColourTriangle {
  std::array<geometry::SnappedPoint, 3> corners{};  // in steps of 2^-fraction_bits pixel
  int fraction_bits = 0;
  std::array<QuadraticForm<double>, 3> colour{};  // red, green, blue, about corner 0
  std::array<double, 3> depth{};                  // at the corners, in units of the depth word
  std::uint32_t object = 0;                       // from 1
  std::uint32_t material = 0;
  // Where a pixel unit shades it: colours are nothing then. Stays where it is until the frame's end.
  const pixel_unit::PixelTriangle* shading = nullptr;
};

struct SpanFormat {
  unsigned word_bits = 32;
  unsigned fraction_bits = 20;
  unsigned depth_fraction_bits = 8;
  unsigned depth_bits = 24;
  span_unit::StartEdge start_edge = span_unit::StartEdge::lattice;
  std::int64_t lines = 512;  // of the screen
  VectorVariant variant = vector_variant();

  static SpanFormat of(const span_unit::SpanUnitParameters& parameters, std::int64_t lines) {
    return {static_cast<unsigned>(parameters.word_bits),
            static_cast<unsigned>(parameters.fraction_bits),
            static_cast<unsigned>(parameters.depth_fraction_bits),
            static_cast<unsigned>(parameters.depth_bits),
            parameters.start_edge,
            lines,
            vector_variant()};
  }
};

// Lines above and below the screen are left out: the host begins at the first line that is seen. A sample on a left or
// a top edge is inside, on others it is not, exactly. No halves where no line of the screen is touched.
span_unit::TriangleLoad span_load(const ColourTriangle& triangle, const SpanFormat& format);
// The same into a load that held another triangle's.
void put_span_load(const ColourTriangle& triangle, const SpanFormat& format, span_unit::TriangleLoad& load);

// What it costs the host; `linear`: the machine's second differences are wired to zero (Gouraud).
struct SpanLoadCosts {
  geometry::OperationCounts triangle;  // sorting, the depth plane
  geometry::OperationCounts start;     // a half whose start edge and registers are loaded
  geometry::OperationCounts goes_on;   // one that goes on with them
};
SpanLoadCosts span_load_costs(bool linear);
// The same without colours.
SpanLoadCosts depth_load_costs();
geometry::OperationCounts cost_of(const span_unit::TriangleLoad& load, const SpanLoadCosts& costs);

}  // namespace rastertlm::set_up
