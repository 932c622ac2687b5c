#include "modules/set_up/midpoint_grid.h"

#include <algorithm>

namespace rastertlm::set_up {

// Points (i, j), i + j <= side: corner 0 is (0, 0), corner 1 (side, 0), corner 2 (0, side).
MidpointGrid::MidpointGrid(std::int64_t halvings, PointLighting& lighting)
    : lighting_(lighting),
      side_(std::size_t{1} << static_cast<unsigned>(halvings)),
      points_((side_ + 1) * (side_ + 2) / 2) {}

// Points between those that are 2 `step` apart.
void MidpointGrid::halve(std::size_t step) {
  for (std::size_t j = 0; j <= side_; j += step)
    for (std::size_t i = 0; i + j <= side_; i += step) {
      const bool across = i / step % 2 != 0, down = j / step % 2 != 0;
      if (!across && !down) continue;
      const LitCorner& a = points_[index(across ? i - step : i, down && !across ? j - step : (down ? j + step : j))];
      const LitCorner& b = points_[index(across ? i + step : i, down && !across ? j + step : (down ? j - step : j))];
      LitCorner& middle = points_[index(i, j)];
      middle.point = lighting_.middle(a.point, b.point);
      middle.depth = (a.depth + b.depth) * 0.5;
      ++operations_.add;
      ++operations_.multiply;
    }
}

void MidpointGrid::light(std::uint32_t material) {
  const auto is_corner = [&](std::size_t k) {
    return k == index(0, 0) || k == index(side_, 0) || k == index(0, side_);
  };
  unlit_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!is_corner(k)) unlit_.push_back(points_[k].point);
  levels_.resize(unlit_.size());
  for (std::size_t done = 0; done < unlit_.size(); done += kLightLanes) {
    const std::size_t count = std::min<std::size_t>(kLightLanes, unlit_.size() - done);
    lighting_.levels({unlit_.data() + done, count}, material, {levels_.data() + done, count});
  }
  auto level = levels_.begin();
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!is_corner(k)) points_[k].levels = *level++;
}

void MidpointGrid::cut(const LitTriangle& triangle, std::uint32_t material, std::vector<LitTriangle>& out) {
  points_[index(0, 0)] = triangle[0];
  points_[index(side_, 0)] = triangle[1];
  points_[index(0, side_)] = triangle[2];
  for (std::size_t step = side_ / 2; step > 0; step /= 2) halve(step);
  light(material);
  const auto at = [this](std::size_t i, std::size_t j) { return points_[index(i, j)]; };
  for (std::size_t j = 0; j < side_; ++j)
    for (std::size_t i = 0; i + j < side_; ++i) {
      out.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < side_) out.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

}  // namespace rastertlm::set_up
