// A picture whose pixels are numbers that stand for something.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/report/blame_figures.h"

namespace rastertlm::report {

struct LabelledPicture {
  std::string channel;                // of the EXR
  std::string file;                   // of the coloured picture
  std::vector<std::uint32_t> values;  // a pixel, in rows from the top left
  Legend legend;
};

// 3 levels a pixel: its colour by the legend, black for a number that this does not have.
std::vector<std::uint8_t> painted(const LabelledPicture& picture);

}  // namespace rastertlm::report
