// Figure 7 of 001, row by row: what the start edge's registers and those of a pixel hold, clock by clock.
#pragma once

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "modules/span_unit/span_words.h"

namespace rastertlm::test {

struct Figure7Row {
  int clock = 0;
  bool load_line = false;  // after the first, every one is a line step
  std::uint32_t line = 0;
  std::uint32_t pixel = 0;
  std::uint64_t line_step = 0, start = 0, pixel_step = 0, di = 0, i = 0;
};

inline std::vector<Figure7Row> figure_7() {
  std::ifstream file(std::string(RASTERTLM_SOURCE_DIR) + "/tests/golden/fig7_span_unit_trace.csv");
  std::vector<Figure7Row> rows;
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text[0] == '#' || text.starts_with("clock") || text.find("reset") != std::string::npos)
      continue;
    std::vector<std::string> cells;
    std::istringstream line(text);
    for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
    const auto hex = [&](std::size_t k) { return std::stoull(cells.at(k), nullptr, 16); };
    const auto number = [&](std::size_t k) { return static_cast<std::uint32_t>(std::stoul(cells.at(k))); };
    rows.push_back(
        {std::stoi(cells[0]), cells[1] == "load_line", number(2), number(3), hex(4), hex(5), hex(6), hex(7), hex(8)});
  }
  return rows;
}

// The six numbers that are the figure's inputs; everything else follows.
inline constexpr span_unit::ColourWords kFigure7{0x06AFFFF8, 0xFFFD1688, 0x00150725,
                                                 0xFFFFEF9E, 0xFFFFF45E, 0xFFFFFB1E};

// Its triangle: lines of one, two, three and four pixels beside a vertical edge.
inline span_unit::TriangleLoad figure_7_load() {
  span_unit::TriangleLoad load;
  load.count = 1;
  load.object = 1;
  span_unit::HalfTriangle& half = load.halves[0];
  half.lines = 4;
  half.end.column = 1;
  half.end.step = 1;
  for (std::size_t channel = 0; channel < span_unit::kChannels; ++channel)
    span_unit::put_words(kFigure7, channel, half.registers);
  span_unit::put_words({}, span_unit::kDepthSet, half.registers);
  return load;
}

}  // namespace rastertlm::test
