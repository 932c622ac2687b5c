// Polygons into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace rastertlm::scene {

// A simple, about flat polygon of n >= 3 corners, convex or not, into n - 2 triangles of the same orientation; the
// numbers count in `corners`. Ears are cut from the first corner on, so that a convex polygon gives a fan.
std::vector<std::array<std::uint32_t, 3>> triangulate(const std::vector<glm::dvec3>& corners);

}  // namespace rastertlm::scene
