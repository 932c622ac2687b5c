#include "src/reference/pieces.h"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace rastertlm::reference {
namespace {

using geometry::ClipTriangle;
using geometry::ClipVertex;
using geometry::Polygon;
using geometry::SnappedPoint;
using geometry::Viewport;

using Vertices = std::vector<std::vector<ClipVertex<double>>>;  // of each object's mesh

Vertices clip_vertices(const scene::Scene& scene, const scene::Pose& pose) {
  Vertices all(scene.objects.size());
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Mesh& mesh = scene.objects[o].mesh;
    const glm::dmat4 object_to_clip = pose.eye_to_clip * pose.object_to_eye[o];
    all[o].resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      all[o][v].position = geometry::transform_point<double>(object_to_clip, mesh.positions[v]);
      all[o][v].normal = geometry::transform_normal<double>(pose.normal_to_eye[o], mesh.normals[v]);
    }
  }
  return all;
}

ClipTriangle<double> triangle_of(const std::vector<ClipVertex<double>>& vertices,
                                 const std::array<std::uint32_t, 3>& indices) {
  return {vertices[indices[0]], vertices[indices[1]], vertices[indices[2]]};
}

bool any_needs_guard_band(const scene::Scene& scene, const Vertices& vertices, const RenderOptions& options,
                          const Viewport& viewport) {
  for (std::size_t o = 0; o < scene.objects.size(); ++o)
    for (const auto& indices : scene.objects[o].mesh.triangles)
      if (geometry::needs_guard_band(triangle_of(vertices[o], indices), options.grids.on_screen, viewport)) return true;
  return false;
}

int sign(double x) { return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0); }

int area_sign(const Piece& piece, bool by_snapped) {
  if (by_snapped) {
    const std::int64_t area = geometry::doubled_area(piece.snapped[0], piece.snapped[1], piece.snapped[2]);
    return area > 0 ? 1 : (area < 0 ? -1 : 0);
  }
  const auto& [a, b, c] = piece.corners;
  return sign((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
}

// False where the piece is not seen.
bool turn_to_viewer(Piece& piece, bool two_sided, bool by_snapped) {
  const int area = area_sign(piece, by_snapped);
  if (area == 0) return false;
  const bool front = geometry::faces_viewer(area);
  if (!front && !two_sided) return false;
  if (front) {  // counter-clockwise as seen: turned round
    std::swap(piece.corners[1], piece.corners[2]);
    std::swap(piece.snapped[1], piece.snapped[2]);
    std::swap(piece.eye_positions[1], piece.eye_positions[2]);
  } else {
    for (auto& corner : piece.corners) corner.normal = -corner.normal;
  }
  return true;
}

// Hands on what is cut of each triangle, in their order.
class Assembler {
 public:
  Assembler(const scene::Pose& pose, const RenderOptions& options, const geometry::FrameGrid& grid, bool snaps)
      : options_(options),
        viewport_{options.columns, options.lines},
        grid_(grid),
        clip_to_eye_(glm::inverse(pose.eye_to_clip)),
        snaps_(snaps) {}

  template <class Take>
  void add(const ClipTriangle<double>& triangle, const Piece& what, const Take& take) const {
    const Polygon<double> polygon = drawn_polygon(triangle);
    for (std::size_t k = 1; k + 1 < polygon.size; ++k) {
      Piece piece = what;
      place(piece, {polygon.corners[0], polygon.corners[k], polygon.corners[k + 1]});
      take(piece);
    }
  }

 private:
  Polygon<double> drawn_polygon(const ClipTriangle<double>& triangle) const {
    if (geometry::needs_guard_band(triangle, options_.grids.on_screen, viewport_))
      return geometry::clip_to_frame(triangle, grid_);
    Polygon<double> polygon;
    for (const ClipVertex<double>& vertex : triangle) polygon.add(vertex);
    return polygon;
  }

  void place(Piece& piece, const ClipTriangle<double>& corners) const {
    for (std::size_t i = 0; i < 3; ++i) {
      piece.corners[i] = geometry::to_screen(corners[i], viewport_);
      if (snaps_) piece.snapped[i] = geometry::snap(piece.corners[i], grid_.grid.fraction_bits);
      if (options_.kind == Reference::true_model || options_.lights_at_points)
        piece.eye_positions[i] = eye_position(corners[i]);
    }
  }

  glm::dvec3 eye_position(const ClipVertex<double>& vertex) const {
    const glm::dvec4 p = clip_to_eye_ * glm::dvec4(vertex.position);
    return glm::dvec3(p) / p.w;
  }

  const RenderOptions& options_;
  Viewport viewport_;
  geometry::FrameGrid grid_;
  glm::dmat4 clip_to_eye_;
  bool snaps_;
};

// Calls take(piece, two_sided) for everything that is cut of the frame's triangles; gives their grid.
template <class Take>
geometry::FrameGrid cut_all(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options,
                            bool snaps, const Take& take) {
  const Viewport viewport{options.columns, options.lines};
  const Vertices vertices = clip_vertices(scene, pose);
  const geometry::FrameGrid grid =
      geometry::frame_grid(options.grids, any_needs_guard_band(scene, vertices, options, viewport), viewport);
  const Assembler assembler(pose, options, grid, snaps);
  std::uint32_t number = 0;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const scene::Mesh& mesh = scene.objects[o].mesh;
    if (scene.objects[o].solid) ++number;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Piece what;
      what.object = ++number;
      what.material = mesh.material[t];
      what.body = static_cast<std::uint32_t>(o);
      assembler.add(triangle_of(vertices[o], mesh.triangles[t]), what,
                    [&](Piece& piece) { take(piece, scene.objects[o].two_sided); });
    }
  }
  return grid;
}

}  // namespace

Pieces pieces(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options) {
  const bool snaps = options.kind == Reference::snapped;
  Pieces result;
  result.grid = cut_all(scene, pose, options, snaps, [&](Piece& piece, bool two_sided) {
    if (turn_to_viewer(piece, two_sided, snaps)) result.list.push_back(piece);
  });
  return result;
}

CutPieces cut_pieces(const scene::Scene& scene, const scene::Pose& pose, const RenderOptions& options) {
  CutPieces result;
  result.grid = cut_all(scene, pose, options, true, [&](const Piece& piece, bool two_sided) {
    result.list.push_back({piece, two_sided});
  });
  return result;
}

std::optional<Piece> as_seen(const CutPiece& cut, bool by_snapped) {
  Piece piece = cut.piece;
  if (!turn_to_viewer(piece, cut.two_sided, by_snapped)) return std::nullopt;
  return piece;
}

}  // namespace rastertlm::reference
