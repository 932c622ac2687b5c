// What the host's arithmetic costs on each path through it. A triangle that needs no guard band takes the same
// operations as every other on its path, so they are counted once, by the code itself with Counted numbers, and
// triangles are computed with plain ones. Clipped triangles, and edges at scales of their own, take as many operations
// as their numbers ask for: those are computed with Counted numbers every time.
#pragma once

#include <glm/mat4x4.hpp>

#include "modules/set_up/triangle_set_up.h"
#include "src/geometry/counted.h"

namespace rastertlm::host {

struct PathCounts {
  geometry::OperationCounts matrix;        // object to clip space
  geometry::OperationCounts three_inside;  // corners to the screen, none of which needs the guard band
  // Fitting, by what becomes of the triangle; means something for snapped edges alone.
  geometry::OperationCounts drawn;
  geometry::OperationCounts back_face;
  geometry::OperationCounts degenerate;

  const geometry::OperationCounts& of(set_up::Outcome outcome) const {
    return outcome == set_up::Outcome::drawn ? drawn : outcome == set_up::Outcome::back_face ? back_face : degenerate;
  }
};

// Of this program's arithmetic: the same for every machine and scene.
PathCounts count_paths();

// left * right. T: Counted<double> or double.
template <class T>
glm::dmat4 matrix_product(const glm::dmat4& left, const glm::dmat4& right) {
  glm::dmat4 result;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      T sum = T(left[0][row]) * T(right[column][0]);
      for (int k = 1; k < 4; ++k) sum += T(left[k][row]) * T(right[column][k]);
      result[column][row] = geometry::plain(sum);
    }
  return result;
}

}  // namespace rastertlm::host
