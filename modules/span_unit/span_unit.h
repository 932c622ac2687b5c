// The span unit (000/001, section 5): draws a triangle from its load, line by line, one pixel a clock. The registers at
// a line's first pixel are those of figure 6 (span_registers.h, tested); whoever wants its pixels steps on from there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/span_unit/line_kernels.h"
#include "modules/span_unit/parameters.h"
#include "modules/span_unit/span.h"
#include "modules/span_unit/span_words.h"
#include "src/base/vector_variant.h"

namespace rastertlm::span_unit {

struct SpanCounters {
  std::uint64_t triangles = 0;
  std::uint64_t lines = 0;
  std::uint64_t empty_lines = 0;  // of them, without a pixel
  std::uint64_t carries = 0;
  std::uint64_t pixels = 0;      // on the screen
  std::uint64_t off_screen = 0;  // stepped over, left of the screen
  std::uint64_t steps = 0;       // at most, of the longest iteration: lines, carries and widest line of a triangle
  SpanCounters& operator+=(const SpanCounters& other);
};

// A triangle's lines on the screen, in order; also those without a pixel, which take a clock. Pixels left of the screen
// are stepped over, a clock each; a line ends at the screen's right edge.
struct DrawnLines {
  std::span<const Span> spans;
  std::uint64_t pixels = 0;  // on the screen
  std::uint64_t cycles = 0;  // of all lines, changes between them not counted in
};

class SpanUnit {
 public:
  SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines,
           VectorVariant variant = vector_variant());

  // Valid until the next call.
  DrawnLines draw(const TriangleLoad& triangle);

  const SpanCounters& counters() const { return counters_; }

 private:
  // Of a line whose first pixel on the screen is not where the registers stand.
  struct Shift {
    std::uint64_t skipped = 0;   // pixels left of the screen
    std::int64_t rest_bits = 0;  // prestep: from the edge to the first pixel, in prestep_bits
  };
  // A triangle while its halves are drawn: edges and registers at the last line so far, and what was found.
  struct Drawing {
    EdgeWords start;
    EdgeWords end;
    StartEdgeRegisters registers;
    bool start_goes_on = false;  // from the half before
    bool end_goes_on = false;
    std::size_t line = 0;  // of the triangle
    std::uint64_t pixels = 0;
    std::uint64_t cycles = 0;
    std::uint32_t widest = 0;  // pixels of a line, those included that are stepped over
  };
  bool lies_on_screen(const Drawing& drawing, std::int64_t lines) const;
  void draw_on_screen(const HalfTriangle& half, Drawing& drawing);
  void cross(const HalfTriangle& half, Drawing& drawing);
  void step(const HalfTriangle& half, Drawing& drawing);
  Shift shift_of(const EdgeWords& start, const EdgeWords& end);
  void shift(Span& span, const Shift& at) const;

  SpanUnitParameters parameters_;
  std::int64_t columns_;
  std::int64_t sharing_;  // units that share the columns
  bool lattice_;
  bool prestepped_;
  bool carry_takes_a_clock_;
  const LineKernels& kernels_;
  std::vector<Span> spans_;            // the first ones are the last triangle's
  std::vector<std::uint8_t> carries_;  // of each: the registers make a second step
  std::vector<Shift> shifts_;
  SpanCounters counters_;
};

PixelFormat pixel_format(const SpanUnitParameters& parameters);

}  // namespace rastertlm::span_unit
