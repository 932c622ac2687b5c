// Frames of interlaced video, woven of two fields: the even lines of one picture and the odd lines of another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "src/frame/frame.h"

namespace rastertlm::frame {

// Copies lines first_line, first_line + step, ... of `from` into `into`, which takes its size.
inline void copy_lines(const ExactFrame& from, std::size_t first_line, std::size_t step, ExactFrame& into) {
  if (into.columns != from.columns || into.lines != from.lines) into.resize(from.columns, from.lines);
  const auto copy = [&](const auto& source, auto& target, std::size_t values_a_pixel) {
    const std::size_t width = values_a_pixel * from.columns;
    for (std::size_t line = first_line; line < from.lines; line += step)
      std::copy_n(source.begin() + static_cast<std::ptrdiff_t>(line * width), width,
                  target.begin() + static_cast<std::ptrdiff_t>(line * width));
  };
  copy(from.rgb, into.rgb, 3);
  copy(from.object, into.object, 1);
  copy(from.depth, into.depth, 1);
  copy(from.coverage, into.coverage, 1);
  copy(from.region, into.region, 1);
  copy(from.edges, into.edges, 1);
  // What lies below a line is of the other picture.
  if (step > 1)
    for (std::uint8_t& edges : into.edges) edges &= kEdgeToTheRight;
}

}  // namespace rastertlm::frame
