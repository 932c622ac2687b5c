// The control points of the Utah teapot.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace rastertlm::scene {

inline constexpr std::size_t kTeapotPatches = 32;
using TeapotPatch = std::array<glm::dvec3, 16>;  // row by row

extern const std::array<TeapotPatch, kTeapotPatches> kNewellTeapot;

}  // namespace rastertlm::scene
