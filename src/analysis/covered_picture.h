// How often a machine covers each pixel of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/analysis/triangle_screen.h"

namespace rastertlm::analysis {

struct Position {
  double x, y, z;  // pixels; z towards the eye
};
using Facet = std::array<Position, 3>;

// Twice the area; negative where the corners run counter-clockwise as seen.
double doubled_area(const Facet& t);

// How often a pixel is to be covered, or nothing where nothing is said.
inline constexpr int kAnyCount = -1;
using ExpectedCount = std::function<int(double x, double y)>;

// A triangle that the grid has folded over counts -1: a mesh whose neighbours share edges covers what is inside its
// outline once, whatever the grid does to its triangles.
class CoveredPicture {
 public:
  // `grid`: the frame's, of the screen's two. The screen must outlive it.
  CoveredPicture(TriangleScreen& screen, const geometry::SnapGrid& grid);

  void clear();
  void draw(const Facet& facet);

  std::int64_t columns() const { return columns_; }
  std::int64_t lines() const { return lines_; }
  int count(std::int64_t x, std::int64_t y) const { return count_[static_cast<std::size_t>(y * columns_ + x)]; }
  // Pixels whose count is another than the expected.
  std::int64_t differing(const ExpectedCount& expected) const;
  std::int64_t triangles() const { return triangles_; }
  std::int64_t folded() const { return folded_; }
  bool is_exact() const { return screen_.is_exact(); }

 private:
  TriangleScreen& screen_;
  geometry::SnapGrid grid_;
  std::int64_t columns_;
  std::int64_t lines_;
  std::vector<int> count_;
  std::vector<std::size_t> drawn_;  // pixels of the last triangle
  std::int64_t triangles_ = 0;
  std::int64_t folded_ = 0;
};

}  // namespace rastertlm::analysis
