#include "src/report/labelled_picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

namespace rastertlm::report {
namespace {

using Colour = std::array<std::uint8_t, 3>;

// Of "#rrggbb".
Colour colour_of(const std::string& text) {
  constexpr int kHexadecimal = 16;
  Colour colour{};
  for (std::size_t c = 0; c < colour.size() && text.size() >= 2 * c + 3; ++c) {
    const char* digits = text.data() + 1 + 2 * c;
    std::from_chars(digits, digits + 2, colour[c], kHexadecimal);
  }
  return colour;
}

}  // namespace

std::vector<std::uint8_t> painted(const LabelledPicture& picture) {
  std::map<std::uint32_t, Colour> colours;
  for (const LegendEntry& entry : picture.legend) colours.emplace(entry.value, colour_of(entry.colour));
  std::vector<std::uint8_t> rgb(3 * picture.values.size(), 0);
  for (std::size_t i = 0; i < picture.values.size(); ++i)
    if (const auto found = colours.find(picture.values[i]); found != colours.end())
      std::copy(found->second.begin(), found->second.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  return rgb;
}

}  // namespace rastertlm::report
