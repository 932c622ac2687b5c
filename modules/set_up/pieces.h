// Vertices from object space to clip space, and what is drawn of a triangle: none, itself, or up to seven pieces.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "modules/set_up/triangle_set_up.h"
#include "src/geometry/clipping.h"
#include "src/geometry/frame_grid.h"
#include "src/geometry/projection.h"

namespace rastertlm::set_up {

// 21 multiplications and 18 additions. `normal_to_eye` makes no normal longer than 1.
template <class T>
geometry::ClipVertex<T> transform_vertex(const glm::dvec3& position, const glm::dvec3& normal,
                                         const glm::dmat4& object_to_clip, const glm::dmat3& normal_to_eye) {
  return {geometry::transform_point<T>(object_to_clip, position), geometry::transform_normal<T>(normal_to_eye, normal)};
}

inline constexpr std::size_t kMaxPieces = geometry::kMaxPolygonCorners - 2;

template <class T>
struct Pieces {
  std::array<ScreenTriangle<T>, kMaxPieces> triangles{};
  std::size_t size = 0;

  std::span<const ScreenTriangle<T>> list() const { return std::span(triangles).first(size); }
};

// The fan (0, k, k + 1) of the clipped polygon, as the exact renderers cut it. Corners keep the triangle's order. A
// frame on the fine grid needs no clipping and pays none.
template <class T>
Pieces<T> pieces(const geometry::ClipTriangle<T>& triangle, const geometry::FrameGrid& frame,
                 const geometry::Viewport& viewport) {
  Pieces<T> result;
  const geometry::Polygon<T> polygon = geometry::clip_to_frame(triangle, frame);
  if (polygon.size < 3) return result;
  std::array<geometry::ScreenVertex<T>, geometry::kMaxPolygonCorners> corners;
  for (std::size_t i = 0; i < polygon.size; ++i) corners[i] = geometry::to_screen(polygon.corners[i], viewport);
  for (std::size_t k = 1; k + 1 < polygon.size; ++k)
    result.triangles[result.size++] = {corners[0], corners[k], corners[k + 1]};
  return result;
}

}  // namespace rastertlm::set_up
