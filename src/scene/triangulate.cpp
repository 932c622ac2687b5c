#include "src/scene/triangulate.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace rastertlm::scene {
namespace {

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Along the largest component of the polygon's normal (Newell's sum), counter-clockwise.
std::vector<glm::dvec2> flatten(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  int axis = 2;
  if (std::fabs(normal.x) > std::fabs(normal.y) && std::fabs(normal.x) > std::fabs(normal.z)) axis = 0;
  if (axis == 2 && std::fabs(normal.y) > std::fabs(normal.z)) axis = 1;
  const int first = (axis + 1) % 3;
  const int second = (axis + 2) % 3;
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& p : corners)
    flat.push_back(normal[axis] < 0.0 ? glm::dvec2(p[second], p[first]) : glm::dvec2(p[first], p[second]));
  return flat;
}

// Whether the corner `at` of what is left can be cut: convex, and no other corner inside its triangle or on its border.
bool is_ear(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const std::size_t before = (at + n - 1) % n;
  const std::size_t after = (at + 1) % n;
  const glm::dvec2 a = flat[left[before]];
  const glm::dvec2 b = flat[left[at]];
  const glm::dvec2 c = flat[left[after]];
  if (!(turn(a, b, c) > 0.0)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == before || i == at || i == after) continue;
    const glm::dvec2 p = flat[left[i]];
    if (p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<glm::dvec3>& corners) {
  const std::vector<glm::dvec2> flat = flatten(corners);
  std::vector<std::uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0U);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() > 3) {
    std::size_t at = 1;
    while (at < left.size() && !is_ear(flat, left, at)) ++at;
    if (at == left.size() && !is_ear(flat, left, 0)) at = 1;  // a polygon that crosses itself: any cut is as good
    at %= left.size();
    const std::size_t n = left.size();
    triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace rastertlm::scene
