// A displayed frame: the levels that the screen shows, and what observers saw of each pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/frame/exact_levels.h"

namespace rastertlm::frame {

// Planes of columns x lines pixels, row by row from the top left.
struct Frame {
  std::size_t columns = 0;
  std::size_t lines = 0;
  std::vector<std::uint8_t> rgb;        // 3 a pixel, levels 0..255
  std::vector<std::uint32_t> depth;     // depth word; background holds the largest
  std::vector<float> normal;            // 3 a pixel, eye space, unit length; 0 where nothing is seen
  std::vector<std::uint32_t> object;    // 0 background, objects count from 1
  std::vector<std::uint32_t> material;  // index of the material, 0 where nothing is seen
  std::vector<std::uint32_t> coverage;  // how many objects cover the pixel

  std::size_t pixels() const { return columns * lines; }
  void resize(std::size_t new_columns, std::size_t new_lines) {
    columns = new_columns;
    lines = new_lines;
    rgb.assign(3 * pixels(), 0);
    depth.assign(pixels(), 0);
    normal.assign(3 * pixels(), 0.0F);
    object.assign(pixels(), 0);
    material.assign(pixels(), 0);
    coverage.assign(pixels(), 0);
  }
};

// The part of an exact picture that a pixel belongs to: one each, of several the last. How the parts are told apart is
// said in src/reference/regions.h.
enum class Region : std::uint8_t {
  none,         // nothing is seen there
  inside,       // of a surface
  highlights,   // where it shines
  silhouettes,  // beside the edge of what is seen, on both sides of it
};
inline constexpr std::size_t kRegions = 4;

// Edges of triangles that lie between a pixel and the next, on a surface that goes on beyond them.
inline constexpr std::uint8_t kEdgeToTheRight = 1;
inline constexpr std::uint8_t kEdgeBelow = 2;

// The exact picture.
struct ExactFrame {
  std::size_t columns = 0;
  std::size_t lines = 0;
  ExactLevels rgb;                    // 3 a pixel, 0..255, clamped, not rounded
  std::vector<std::uint32_t> object;  // 0 background, objects count from 1
  std::vector<double> depth;          // 0 near .. 1 far; 1 where nothing is seen
  std::vector<std::uint32_t> coverage;
  std::vector<Region> region;
  std::vector<std::uint8_t> edges;  // kEdgeToTheRight | kEdgeBelow

  std::size_t pixels() const { return columns * lines; }
  void resize(std::size_t new_columns, std::size_t new_lines) {
    columns = new_columns;
    lines = new_lines;
    rgb.resize(pixels());
    object.assign(pixels(), 0);
    depth.assign(pixels(), 1.0);
    coverage.assign(pixels(), 0);
    region.assign(pixels(), Region::none);
    edges.assign(pixels(), 0);
  }
};

}  // namespace rastertlm::frame
