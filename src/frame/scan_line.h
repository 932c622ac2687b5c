// One scan line as it crosses a link, in plain memory: structure of arrays, so that the vector units see contiguous
// words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rastertlm::frame {

// Pixels [begin, end) may hold something; outside lies background, and its words are not kept up to date: who reads a
// line looks at the covered interval only. Inside, `object` 0 marks a pixel that nothing covers; its other words then
// mean nothing but for depth, which is `background_depth`.
struct FragmentLine {
  std::vector<std::uint32_t> depth;  // unsigned, smaller is nearer; all ones of the depth word is "nothing"
  std::vector<std::uint16_t>
      normal_x;  // words of normal_bits as they cross the link: sign bit above a one's complement magnitude
  std::vector<std::uint16_t> normal_y;
  std::vector<std::uint16_t> normal_z;
  std::vector<std::uint8_t> material;
  std::vector<std::uint32_t> object;    // observer: number of the object that is seen, from 1; 0 is the background
  std::vector<std::uint16_t> coverage;  // observer: how many objects cover the pixel, modulo 2^16
  std::size_t begin = 0;
  std::size_t end = 0;

  // What vectors may read and write behind the last column.
  static constexpr std::size_t kSpare = 64;

  std::size_t columns() const { return columns_; }
  bool empty() const { return begin >= end; }

  void resize(std::size_t columns) {
    columns_ = columns;
    depth.resize(columns + kSpare);
    normal_x.resize(columns + kSpare);
    normal_y.resize(columns + kSpare);
    normal_z.resize(columns + kSpare);
    material.resize(columns + kSpare);
    object.resize(columns + kSpare);
    coverage.resize(columns + kSpare);
    clear();
  }
  void clear() { begin = end = 0; }

  // Makes [first, last) part of the covered interval, initialising what is new to background.
  void extend(std::size_t first, std::size_t last, std::uint32_t background_depth) {
    if (first >= last) return;
    if (empty()) {
      fill_background(first, last, background_depth);
      begin = first;
      end = last;
      return;
    }
    if (first < begin) {
      fill_background(first, begin, background_depth);
      begin = first;
    }
    if (last > end) {
      fill_background(end, last, background_depth);
      end = last;
    }
  }

 private:
  void fill_background(std::size_t first, std::size_t last, std::uint32_t background_depth) {
    const auto from = static_cast<std::ptrdiff_t>(first);
    const auto to = static_cast<std::ptrdiff_t>(last);
    std::fill(depth.begin() + from, depth.begin() + to, background_depth);
    std::fill(object.begin() + from, object.begin() + to, 0U);
    std::fill(coverage.begin() + from, coverage.begin() + to, std::uint16_t{0});
  }

  std::size_t columns_ = 0;
};

// One line of display levels, red, green and blue interleaved, 0..255.
struct RgbLine {
  std::vector<std::uint8_t> levels;  // 3 * columns
  std::size_t columns() const { return levels.size() / 3; }
  void resize(std::size_t columns) { levels.assign(3 * columns, 0); }
};

}  // namespace rastertlm::frame
