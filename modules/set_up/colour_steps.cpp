#include "modules/set_up/colour_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

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

// Corners of children that were moved are beside their parents' edges: halves of an edge are looked for by their ends.
class MovedSteps {
 public:
  MovedSteps(std::span<const ColourTriangle> triangles, int moved_bits) : moved_bits_(moved_bits) {
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

// Edges on a line, in its order: `from` is the end that is further left, or higher.
struct OnLine {
  std::array<std::int64_t, 3> line{};  // least whole numbers of its direction; its cross product with any point
  std::int64_t begin = 0, end = 0;     // along it
  SnappedPoint from, to;
  double depth_from = 0.0, depth_to = 0.0;
  const ColourTriangle* triangle = nullptr;
  bool in_parts = false;  // somebody else's corner lies inside

  double depth(std::int64_t at) const {
    const double share = static_cast<double>(at - begin) / static_cast<double>(end - begin);
    return depth_from + share * (depth_to - depth_from);
  }
  // Of one surface, not of two that one sees behind each other.
  bool is_as_deep(const OnLine& other, std::int64_t low, std::int64_t high) const {
    constexpr double kSame = 1.0;  // unit of the depth word
    return std::fabs(depth(low) - other.depth(low)) < kSame && std::fabs(depth(high) - other.depth(high)) < kSame;
  }
};

OnLine on_line(const ColourTriangle& triangle, std::size_t first, std::size_t second) {
  if (std::tie(triangle.corners[second].x, triangle.corners[second].y) <
      std::tie(triangle.corners[first].x, triangle.corners[first].y))
    std::swap(first, second);
  const SnappedPoint &p = triangle.corners[first], &q = triangle.corners[second];
  const std::int64_t divisor = std::max<std::int64_t>(std::gcd(q.x - p.x, q.y - p.y), 1);
  const std::int64_t dx = (q.x - p.x) / divisor, dy = (q.y - p.y) / divisor;
  const bool level = dx != 0;
  return {{dx, dy, dx * p.y - dy * p.x}, level ? p.x : p.y,      level ? q.x : q.y, p,    q,
          triangle.depth[first],         triangle.depth[second], &triangle,         false};
}

// Corners of parts are exactly on the edges: what overlaps on a line, and is not the same, is compared where it does.
ColourSteps exact_steps(std::span<const ColourTriangle> triangles) {
  std::vector<OnLine> edges;
  edges.reserve(3 * triangles.size());
  for (const ColourTriangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(on_line(triangle, i, (i + 1) % 3));
  std::sort(edges.begin(), edges.end(), [](const OnLine& a, const OnLine& b) {
    return std::tie(a.line, a.begin, a.end, a.triangle) < std::tie(b.line, b.begin, b.end, b.triangle);
  });
  ColourSteps result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    OnLine& one = edges[i];
    for (std::size_t j = i + 1; j < edges.size() && edges[j].line == one.line && edges[j].begin < one.end; ++j) {
      OnLine& other = edges[j];
      if (other.begin == one.begin && other.end == one.end) continue;
      if (!one.is_as_deep(other, other.begin, std::min(one.end, other.end))) continue;
      // It begins no earlier.
      one.in_parts = one.in_parts || other.begin > one.begin || other.end < one.end;
      other.in_parts = other.in_parts || one.end < other.end;
      const SnappedPoint& to = one.end < other.end ? one.to : other.to;
      result.largest_levels =
          std::max(result.largest_levels, step_along(*one.triangle, *other.triangle, other.from, to));
    }
    result.edges += one.in_parts ? 1 : 0;
  }
  return result;
}

}  // namespace

ColourSteps colour_steps(std::span<const ColourTriangle> triangles, int moved_bits) {
  if (moved_bits == 0) return exact_steps(triangles);
  MovedSteps steps(triangles, moved_bits);
  ColourSteps result;
  for (const ColourTriangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (steps.compare(triangle, triangle.corners[i], triangle.corners[(i + 1) % 3])) ++result.edges;
  result.largest_levels = steps.largest();
  return result;
}

}  // namespace rastertlm::set_up
