// A triangle's half line by line: its edges, and what the registers of the start edge hold. Compiled for several
// instruction sets; all give the same words, and which one is used is chosen at run time (src/base/vector_variant.h).
// The sources of the kernels include this header and nothing that other code shares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/span_unit/span.h"
#include "src/base/vector_variant.h"

namespace rastertlm::span_unit {

// A half, every pixel of which is on the screen.
struct HalfLines {
  EdgeRegisters* start = nullptr;
  EdgeRegisters* end = nullptr;
  // -1: the edge, and with the start edge the registers, are those of the line before the first; 0: of the first.
  std::int64_t start_goes_on = 0;
  std::int64_t end_goes_on = 0;
  std::int64_t carry_steps = 0;  // -1: where the start edge carries, the registers make a step of a pixel as well
  std::int64_t carry_cycles = 0;
  std::int64_t pixel_cycles = 1;
  std::uint32_t first_line = 0;
  std::size_t lines = 0;
};

struct HalfSums {
  std::uint64_t pixels = 0;
  std::uint64_t cycles = 0;
  std::uint64_t carries = 0;
  std::uint64_t empty_lines = 0;
};

struct LineKernels {
  // Draws a half: its spans, and the sums over them. Leaves edges, and in `last` the registers, as they are at its last
  // line; `first` may be `last`.
  HalfSums (*half)(const HalfLines& half, const StartEdgeRegisters& first, StartEdgeRegisters& last, Span* spans);
  // Steps to each of `lines` lines in turn and puts what stands there into its span. `carries`: 0, or 1 where a step of
  // a pixel is made as well.
  void (*step)(StartEdgeRegisters& registers, const std::uint8_t* carries, std::size_t lines, Span* spans);
};

const LineKernels& line_kernels(VectorVariant variant);

}  // namespace rastertlm::span_unit
