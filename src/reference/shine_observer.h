// What of a surface's light is specular: tells highlights from the rest.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

namespace rastertlm::reference {

// Sums what specular light adds, for geometry::illumination.
struct ShineObserver {
  glm::dvec3& sum;
  void operator()(bool /*lit*/, bool /*shines*/) const {}
  void shine(int channel, double light) const { sum[channel] += light; }
};

// The channel that it adds most to, in levels.
inline float largest_level(const glm::dvec3& shine) {
  return static_cast<float>(255.0 * std::max({shine.x, shine.y, shine.z}));
}

}  // namespace rastertlm::reference
