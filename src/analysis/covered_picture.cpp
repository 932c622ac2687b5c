#include "src/analysis/covered_picture.h"

#include <algorithm>

namespace rastertlm::analysis {

double doubled_area(const Facet& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

CoveredPicture::CoveredPicture(TriangleScreen& screen, const geometry::SnapGrid& grid)
    : screen_(screen),
      grid_(grid),
      columns_(static_cast<std::int64_t>(screen.viewport().columns)),
      lines_(static_cast<std::int64_t>(screen.viewport().lines)),
      count_(screen.viewport().columns * screen.viewport().lines) {}

void CoveredPicture::clear() { std::fill(count_.begin(), count_.end(), 0); }

void CoveredPicture::draw(const Facet& facet) {
  set_up::ScreenTriangle<double> corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = {facet[i].x, facet[i].y, 0.5, 1.0, {0.0, 0.0, 1.0}};
  drawn_.clear();
  const int orientation = screen_.draw(corners, grid_, [this](std::int64_t x, std::int64_t y, double /*depth*/) {
    drawn_.push_back(static_cast<std::size_t>(y * columns_ + x));
  });
  ++triangles_;
  const bool fold = (orientation > 0) != (doubled_area(facet) < 0);
  folded_ += orientation != 0 && fold ? 1 : 0;
  for (const std::size_t pixel : drawn_) count_[pixel] += fold ? -1 : 1;
}

std::int64_t CoveredPicture::differing(const ExpectedCount& expected) const {
  std::int64_t off = 0;
  for (std::int64_t y = 0; y < lines_; ++y)
    for (std::int64_t x = 0; x < columns_; ++x) {
      const int wanted = expected(static_cast<double>(x), static_cast<double>(y));
      off += wanted != kAnyCount && count(x, y) != wanted ? 1 : 0;
    }
  return off;
}

}  // namespace rastertlm::analysis
