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
  const auto copy = [&](const auto& source, auto& target) {
    const std::size_t width = from.columns;
    for (std::size_t line = first_line; line < from.lines; line += step)
      std::copy_n(source.begin() + static_cast<std::ptrdiff_t>(line * width), width,
                  target.begin() + static_cast<std::ptrdiff_t>(line * width));
  };
  for (std::size_t line = first_line; line < from.lines; line += step)
    into.rgb.copy(from.rgb, line * from.columns, from.columns);
  copy(from.object, into.object);
  copy(from.depth, into.depth);
  copy(from.coverage, into.coverage);
  copy(from.region, into.region);
  copy(from.edges, into.edges);
  // What lies below a line is of the other picture.
  if (step > 1)
    for (std::uint8_t& edges : into.edges) edges &= kEdgeToTheRight;
}

}  // namespace rastertlm::frame
