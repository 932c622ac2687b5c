// The span unit (000/001, section 5): draws a triangle from its load, line by line, one pixel a clock. The registers at
// a line's first pixel are those of figure 6 (span_registers.h, tested); whoever wants its pixels steps on from there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/span_unit/parameters.h"
#include "modules/span_unit/span.h"
#include "modules/span_unit/span_words.h"

namespace rastertlm::span_unit {

struct SpanCounters {
  std::uint64_t triangles = 0;
  std::uint64_t lines = 0;
  std::uint64_t empty_lines = 0;  // of them, without a pixel
  std::uint64_t carries = 0;
  std::uint64_t pixels = 0;      // on the screen
  std::uint64_t off_screen = 0;  // stepped over, left of the screen
  SpanCounters& operator+=(const SpanCounters& other);
};

class SpanUnit {
 public:
  SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines);

  // Every line of the load, in order; also those without a pixel, which take a clock. Pixels left of the screen are
  // stepped over, a clock each; the line ends at the screen's right edge. Valid until the next call.
  std::span<const Span> draw(const TriangleLoad& triangle);

  const SpanCounters& counters() const { return counters_; }

 private:
  // The running registers at the start edge, a set of them each.
  using Words = std::array<std::uint64_t, kRegisterSets>;
  struct StartEdgeRegisters {
    Words start{}, line_step{}, pixel_step{}, line_line{}, line_pixel{}, pixel_pixel{};
  };
  struct Edges {
    EdgeWords start;
    EdgeWords end;
  };

  void load(const HalfTriangle& half);
  void step_line(bool carries);
  void line(std::int64_t number, const Edges& edges, bool carries, Span& span);
  void prestep(const EdgeWords& start, Span& span) const;

  SpanUnitParameters parameters_;
  std::int64_t columns_;
  std::int64_t sharing_;  // units that share the columns
  bool lattice_;
  bool carry_takes_a_clock_;
  StartEdgeRegisters registers_;
  std::vector<Span> spans_;  // the first ones are the last triangle's
  SpanCounters counters_;
};

PixelFormat pixel_format(const SpanUnitParameters& parameters);

}  // namespace rastertlm::span_unit
