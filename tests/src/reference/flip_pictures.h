// Pairs of pictures by which FLIP is compared with its authors' program: made of integers alone, so that anybody can
// make them again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rastertlm::reference {

struct FlipPicture {
  int columns = 0;
  int lines = 0;
  std::vector<double> levels;  // 3 a pixel, integers 0..255
};

struct FlipPair {
  std::string name;
  FlipPicture reference;
  FlipPicture test;
};

// `level(x, y, channel)` for every pixel.
template <class Level>
FlipPicture flip_picture(int columns, int lines, const Level& level) {
  FlipPicture picture{columns, lines, {}};
  for (int y = 0; y < lines; ++y)
    for (int x = 0; x < columns; ++x)
      for (int c = 0; c < 3; ++c) picture.levels.push_back(static_cast<double>(level(x, y, c)));
  return picture;
}

// Noise by a congruential generator.
inline FlipPicture flip_noise(int columns, int lines, std::uint32_t seed, int mask) {
  std::uint32_t state = seed;
  return flip_picture(columns, lines, [&](int, int, int) {
    state = state * 1664525U + 1013904223U;
    return static_cast<int>(state >> 24) & mask;
  });
}

inline std::vector<FlipPair> flip_pairs(int columns, int lines) {
  const auto picture = [&](const auto& level) { return flip_picture(columns, lines, level); };
  const auto ramp = [&](int x, int y, int c) {
    if (c == 0) return 255 * x / columns;
    return c == 1 ? 255 * y / lines : 255 * (x + y) / (columns + lines);
  };
  // A disc of a reddish grey on blue, its edge hard, lit from the left.
  const auto disc = [&](int x, int y, int c) {
    const int dx = 2 * x - columns;
    const int dy = 2 * y - lines;
    if (4 * (dx * dx + dy * dy) > 3 * lines * lines) return c == 2 ? 90 : 20;
    return (c == 0 ? 250 : 180) - 150 * x / columns;
  };
  const auto checks = [](int x, int y, int c) { return ((x / 4 + y / 3) % 2 == 0) == (c != 1) ? 230 : 25; };
  std::vector<FlipPair> pairs;
  pairs.push_back({"noise and other noise", flip_noise(columns, lines, 1, 255), flip_noise(columns, lines, 2, 255)});
  pairs.push_back({"ramps and darker ramps", picture(ramp),
                   picture([&](int x, int y, int c) { return ramp(x, y, c) * (c == 2 ? 7 : 9) / 10; })});
  pairs.push_back({"a disc and the same one pixel to the right", picture(disc),
                   picture([&](int x, int y, int c) { return disc(x - 1, y, c); })});
  pairs.push_back({"checks and their complement", picture(checks),
                   picture([&](int x, int y, int c) { return 255 - checks(x, y, c); })});
  pairs.push_back({"a disc and the same in steps of eight levels", picture(disc),
                   picture([&](int x, int y, int c) { return disc(x, y, c) / 8 * 8; })});
  return pairs;
}

}  // namespace rastertlm::reference
