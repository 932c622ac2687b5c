#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/base/errors.h"
#include "src/scene/animation.h"
#include "src/scene/scene.h"
#include "src/scene/transform.h"
#include "src/scene/view_check.h"

namespace rastertlm::scene {
namespace {

glm::dvec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

// One factor for all normals of the object, so that the longest has length 1 (normals of an object are scaled
// together).
glm::dmat3 normal_matrix(const glm::dmat4& object_to_eye, const Mesh& mesh) {
  const glm::dmat3 matrix = inverse_transpose(glm::dmat3(object_to_eye));
  double longest = 0.0;
  for (const glm::dvec3& normal : mesh.normals) {
    const glm::dvec3 n = matrix * normal;
    longest = std::max(longest, glm::dot(n, n));
  }
  longest = std::sqrt(longest);
  const bool already = std::fabs(longest - 1.0) < 1e-12;  // rounding alone: a rigid map stays what it is
  return longest > 0.0 && !already ? matrix * (1.0 / longest) : matrix;
}

Light to_eye(const Light& light, const glm::dmat4& world_to_eye) {
  Light result = light;
  if (light.kind == LightKind::directional) {
    result.vector = glm::normalize(glm::dmat3(world_to_eye) * light.vector);
  } else {
    result.vector = glm::dvec3(world_to_eye * glm::dvec4(light.vector, 1.0));
  }
  return result;
}

}  // namespace

Pose pose(const Scene& scene, std::int64_t frame, std::size_t columns, std::size_t lines) {
  const CameraDescription& camera = scene.camera;
  const View view =
      animate(View{vector(camera.eye), vector(camera.target), vector(camera.up)}, camera.animation, frame);
  const std::string wrong = what_is_wrong(view);
  if (!wrong.empty()) throw InputError({"", 0, "camera.animation", fmt::format("at frame {}: {}", frame, wrong)});
  const double aspect = static_cast<double>(columns) / static_cast<double>(lines);
  Pose result;
  result.world_to_eye = look_at(view.eye, view.target, view.up);
  result.eye_to_clip = camera.projection == ProjectionKind::perspective
                           ? perspective(camera.vertical_fov_deg, aspect, camera.near, camera.far)
                           : orthographic(camera.height * aspect, camera.height, camera.near, camera.far);
  for (const Object& object : scene.objects) {
    result.object_to_eye.push_back(result.world_to_eye * animate(object.placement, object.animation, frame));
    result.normal_to_eye.push_back(normal_matrix(result.object_to_eye.back(), object.mesh));
  }
  for (const Light& light : scene.lights) result.lights.push_back(to_eye(light, result.world_to_eye));
  return result;
}

bool camera_moves(const Scene& scene) { return moves(scene.camera.animation); }
bool object_moves(const Scene& scene, std::size_t object) { return moves(scene.objects.at(object).animation); }

}  // namespace rastertlm::scene
