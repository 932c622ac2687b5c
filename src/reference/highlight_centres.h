// Where highlights really have their centres: by looking everywhere. Whoever finds them more cleverly is held to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "src/geometry/mesh.h"
#include "src/geometry/pose.h"

namespace rastertlm::reference {

// The normal, linear between the corners, lies half way between light and viewer, and faces both.
struct HighlightCentre {
  std::size_t triangle = 0;
  std::size_t light = 0;
};

// Of a mesh in eye space; the viewer is at the origin, or infinitely far along z. At most one a triangle and light: of
// several that one grid point leads to, one.
std::vector<HighlightCentre> highlight_centres(const geometry::Mesh& mesh, const glm::dmat4& object_to_eye,
                                               const glm::dmat3& normal_to_eye, std::span<const geometry::Light> lights,
                                               bool viewer_at_eye);

}  // namespace rastertlm::reference
