#include "src/scene/view_check.h"

#include <glm/geometric.hpp>

namespace rastertlm::scene {

std::string what_is_wrong(const View& view) {
  const glm::dvec3 forward = view.target - view.eye;
  const double distance = glm::length(forward);
  if (!(distance > 1e-12 * (glm::length(view.eye) + glm::length(view.target))))
    return "eye and target are the same point";
  const double up = glm::length(view.up);
  if (!(up > 0.0)) return "up is zero";
  if (!(glm::length(glm::cross(forward, view.up)) > 1e-9 * distance * up))
    return "up is parallel to the direction of view";
  return "";
}

}  // namespace rastertlm::scene
