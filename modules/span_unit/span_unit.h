// The span unit (000/001, section 5): draws a triangle from its load, line by line, one pixel a clock. What it shows is
// what the registers of figure 6 show (span_registers.h, tested); pixels of a line are computed together.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/span_unit/parameters.h"
#include "modules/span_unit/pixel_kernels.h"
#include "modules/span_unit/span_words.h"
#include "src/base/vector_variant.h"

namespace rastertlm::span_unit {

// The pixels of a line that are on the screen.
struct Span {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t count = 0;
  const std::uint32_t* levels = nullptr;  // red, green, blue from the low byte on; kSparePixels to spare
  const std::uint32_t* depths = nullptr;  // likewise
  std::uint64_t cycles = 0;  // that the unit takes for the line, pixels off the screen and a carry included
};

struct SpanCounters {
  std::uint64_t triangles = 0;
  std::uint64_t lines = 0;
  std::uint64_t empty_lines = 0;  // of them, without a pixel
  std::uint64_t carries = 0;
  std::uint64_t pixels = 0;      // on the screen
  std::uint64_t off_screen = 0;  // stepped over, left of the screen
};

class SpanUnit {
 public:
  SpanUnit(const SpanUnitParameters& parameters, std::uint32_t columns, std::uint32_t lines,
           VectorVariant variant = vector_variant());

  // Calls sink(const Span&) for every line of the load on the screen, in order; also for those without a pixel, which
  // take a clock. Pixels left of the screen are stepped over, a clock each; the line ends at the screen's right edge.
  template <class Sink>
  void draw(const TriangleLoad& triangle, const Sink& sink);

  const SpanCounters& counters() const { return counters_; }

 private:
  struct Line {
    std::int64_t line;
    std::int64_t first;  // column, may be left of the screen
    std::int64_t end;
    bool carries;
    std::int64_t rest;  // over divisor: from the edge to the first column, 0..1
    std::int64_t divisor;
  };
  // The running registers of the start edge.
  struct State {
    std::array<ColourWords, kChannels> colour;
    DepthWords depth;
  };

  void load(const HalfTriangle& half);
  void step_line(bool carries);
  Span pixels(const Line& line);
  std::uint64_t cycles_of(const Line& line) const;
  void prestep(const Line& line, PixelRequest& request) const;

  SpanUnitParameters parameters_;
  std::int64_t columns_;
  std::int64_t lines_;
  bool narrow_;
  bool lattice_;
  const PixelKernels& kernels_;
  State state_;
  std::vector<std::uint32_t> levels_;
  std::vector<std::uint32_t> depths_;
  SpanCounters counters_;
};

template <class Sink>
void SpanUnit::draw(const TriangleLoad& triangle, const Sink& sink) {
  ++counters_.triangles;
  EdgeWords start;
  EdgeWords end;
  for (std::size_t h = 0; h < triangle.count; ++h) {
    const HalfTriangle& half = triangle.halves[h];
    const bool goes_on = h == 1 && triangle.second_goes_on;
    if (!goes_on) {
      load(half);
      start = half.start;
    }
    if (h == 0 || goes_on) end = half.end;
    bool carries = false;
    for (std::int64_t k = 0; k < half.lines; ++k) {
      // The step from the line before; from the first half's last line only where its registers go on.
      if (k > 0 || goes_on) {
        carries = start.advance();
        step_line(carries);
      }
      if (k > 0 || (h == 1 && !goes_on)) end.advance();
      sink(pixels({half.first_line + k, start.column, end.column, carries, start.rest, start.divisor}));
    }
  }
}

}  // namespace rastertlm::span_unit
