// Everything that can move, at one frame: matrices from object to eye to clip space, and the lights as the eye sees
// them.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace rastertlm::geometry {

enum class LightKind { directional, point };

struct Light {
  LightKind kind = LightKind::directional;
  glm::dvec3 vector{0, 0, 1};  // directional: unit, from the surface to the light; point: position
  glm::dvec3 intensity{1.0};
};

struct Pose {
  glm::dmat4 world_to_eye{1.0};
  glm::dmat4 eye_to_clip{1.0};            // z in 0..w from near to far (GLM's _ZO)
  std::vector<glm::dmat4> object_to_eye;  // one an object
  std::vector<glm::dmat3> normal_to_eye;  // one an object: inverse transpose, scaled by one factor an object so that no
                                          // normal of it gets longer than 1
  std::vector<Light> lights;              // in eye space
};

}  // namespace rastertlm::geometry
