#include "modules/set_up/colour_steps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace rastertlm::set_up {
namespace {

using geometry::SnappedPoint;

using Edge = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

Edge edge_of(const SnappedPoint& a, const SnappedPoint& b) {
  const bool in_order = std::tie(a.x, a.y) < std::tie(b.x, b.y);
  const SnappedPoint& first = in_order ? a : b;
  const SnappedPoint& last = in_order ? b : a;
  return {first.x, first.y, last.x, last.y};
}

double level_at(const ColourTriangle& triangle, std::size_t channel, double x, double y) {
  const double unit = std::ldexp(1.0, -triangle.fraction_bits);
  return triangle.colour[channel].at((x - static_cast<double>(triangle.corners[0].x)) * unit,
                                     (y - static_cast<double>(triangle.corners[0].y)) * unit);
}

// Largest |difference| along the segment: of a quadratic, which is known by three values.
double step_along(const ColourTriangle& a, const ColourTriangle& b, const SnappedPoint& p, const SnappedPoint& q) {
  double largest = 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto difference = [&](double t) {
      const double x = static_cast<double>(p.x) + t * static_cast<double>(q.x - p.x);
      const double y = static_cast<double>(p.y) + t * static_cast<double>(q.y - p.y);
      return level_at(a, channel, x, y) - level_at(b, channel, x, y);
    };
    const double start = difference(0.0), middle = difference(0.5), end = difference(1.0);
    largest = std::max({largest, std::fabs(start), std::fabs(middle), std::fabs(end)});
    const double curve = 2 * (start + end - 2 * middle);
    const double slope = 4 * middle - 3 * start - end;
    const double turn = curve != 0.0 ? -slope / (2 * curve) : -1.0;
    if (turn > 0.0 && turn < 1.0) largest = std::max(largest, std::fabs(start + (slope + curve * turn) * turn));
  }
  return largest;
}

class Steps {
 public:
  Steps(std::span<const ColourTriangle> triangles, int moved_bits) : moved_bits_(moved_bits) {
    for (const ColourTriangle& triangle : triangles)
      for (std::size_t i = 0; i < 3; ++i)
        beside_[edge_of(triangle.corners[i], triangle.corners[(i + 1) % 3])].push_back(&triangle);
  }

  // Whether `whole` has the edge alone, and others have it in parts.
  bool compare(const ColourTriangle& whole, const SnappedPoint& p, const SnappedPoint& q) {
    if ((p.x + q.x) % 2 != 0 || (p.y + q.y) % 2 != 0) return false;
    const SnappedPoint middle{moved((p.x + q.x) / 2), moved((p.y + q.y) / 2)};
    if (middle == p || middle == q) return false;
    bool found = false;
    for (const auto& [from, to] : {std::pair(p, middle), std::pair(middle, q)}) {
      const auto part = beside_.find(edge_of(from, to));
      if (part == beside_.end()) {
        found = compare(whole, from, to) || found;
        continue;
      }
      for (const ColourTriangle* other : part->second)
        largest_ = std::max(largest_, step_along(whole, *other, from, to));
      found = true;
    }
    return found;
  }
  double largest() const { return largest_; }

 private:
  std::int64_t moved(std::int64_t v) const {
    return ((v + (std::int64_t{1} << moved_bits_) / 2) >> moved_bits_) << moved_bits_;
  }

  int moved_bits_;
  std::map<Edge, std::vector<const ColourTriangle*>> beside_;
  double largest_ = 0.0;
};

}  // namespace

ColourSteps colour_steps(std::span<const ColourTriangle> triangles, int moved_bits) {
  Steps steps(triangles, moved_bits);
  ColourSteps result;
  for (const ColourTriangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (steps.compare(triangle, triangle.corners[i], triangle.corners[(i + 1) % 3])) ++result.edges;
  result.largest_levels = steps.largest();
  return result;
}

}  // namespace rastertlm::set_up
