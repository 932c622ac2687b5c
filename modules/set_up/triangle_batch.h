// Between triangles one by one (triangle_set_up.h) and eight at a time (triangle_kernels.h).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>

#include "modules/set_up/triangle_kernels.h"
#include "modules/set_up/triangle_set_up.h"
#include "modules/set_up/word_format.h"
#include "src/geometry/projection.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up {

// What the kernel needs to know of a frame's grid. None where triangles are set up one by one: edges at scales of their
// own, or a screen on which sums may leave the 53 bits of a double.
std::optional<FitRequest> fit_request(const geometry::SnapGrid& grid, const WordFormat& format);

// Both matrices outlive it. `on_screen`: the fine grid.
TransformRequest transform_request(const glm::dmat4& object_to_clip, const glm::dmat3& normal_to_eye,
                                   const geometry::SnapGrid& on_screen, const geometry::Viewport& viewport);

template <class T>
ScreenTriangle<T> triangle_of_lane(const ScreenCorners& corners, std::size_t lane) {
  ScreenTriangle<T> triangle;
  for (std::size_t i = 0; i < 3; ++i)
    triangle[i] = {corners.x[i][lane],
                   corners.y[i][lane],
                   corners.z[i][lane],
                   corners.inverse_w[i][lane],
                   {corners.normal[i][0][lane], corners.normal[i][1][lane], corners.normal[i][2][lane]}};
  return triangle;
}

// Of a drawn lane, but for the material.
void take_words(const FittedTriangles& fitted, std::size_t lane, object_processor::TriangleWords& words);

}  // namespace rastertlm::set_up
