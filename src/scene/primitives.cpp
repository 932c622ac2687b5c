#include "src/scene/primitives.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "src/base/mathematics.h"
#include "src/scene/mesh_builder.h"
#include "src/scene/newell_teapot.h"

namespace rastertlm::scene {
namespace {

using Weights = std::array<double, 4>;

// Bernstein's polynomials at k / n, and their derivatives. Written in k and n - k, so that a border that the neighbour
// runs through backwards has the same weights in reverse order, to the bit.
Weights bernstein(std::size_t k, std::size_t n) {
  const auto t = static_cast<double>(k);
  const auto s = static_cast<double>(n - k);
  const double all = static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(n);
  return {s * s * s / all, 3.0 * t * s * s / all, 3.0 * t * t * s / all, t * t * t / all};
}

Weights bernstein_slope(std::size_t k, std::size_t n) {
  const auto t = static_cast<double>(k) / static_cast<double>(n);
  const double s = 1.0 - t;
  return {-3.0 * s * s, 3.0 * s * s - 6.0 * t * s, 6.0 * t * s - 3.0 * t * t, 3.0 * t * t};
}

// Outer and inner pairs apart: reversing weights and points together leaves every rounding as it was.
template <class Point>
glm::dvec3 blend(const Weights& w, const Point& point) {
  return (w[0] * point(0) + w[3] * point(3)) + (w[1] * point(1) + w[2] * point(2));
}

// Weights along a border are 1 and 0, so a border depends on its own four control points only.
glm::dvec3 evaluate(const TeapotPatch& patch, const Weights& rows, const Weights& columns) {
  const auto column_sum = [&](std::size_t column) {
    return blend(rows, [&](std::size_t row) { return patch[4 * row + column]; });
  };
  return blend(columns, column_sum);
}

// A point of the surface. The four weights add up to 1 but for rounding: where a coordinate of all four points is the
// same (a pole, a level border) it is kept as it is, so that a pole is one point whatever the tessellation.
glm::dvec3 mean(const Weights& w, const std::array<glm::dvec3, 4>& p) {
  glm::dvec3 result = blend(w, [&](std::size_t i) { return p[i]; });
  for (int axis = 0; axis < 3; ++axis)
    if (p[0][axis] == p[1][axis] && p[0][axis] == p[2][axis] && p[0][axis] == p[3][axis]) result[axis] = p[0][axis];
  return result + 0.0;  // no negative zero
}

glm::dvec3 surface_point(const TeapotPatch& patch, const Weights& rows, const Weights& columns) {
  std::array<glm::dvec3, 4> sums;
  for (std::size_t column = 0; column < 4; ++column)
    sums[column] = mean(rows, {patch[column], patch[4 + column], patch[8 + column], patch[12 + column]});
  return mean(columns, sums);
}

// The outward normal. All patches of the table have (d/d column) x (d/d row) outwards. Where the patch's row shrinks to
// a point (u = 0 or 1: a pole), d/d column vanishes and grows along u with the mixed derivative, which gives the limit.
glm::dvec3 patch_normal(const TeapotPatch& patch, std::size_t i, std::size_t j, std::size_t n) {
  const Weights row = bernstein(i, n);
  const Weights column = bernstein(j, n);
  const glm::dvec3 along_u = evaluate(patch, bernstein_slope(i, n), column);
  const glm::dvec3 along_v = evaluate(patch, row, bernstein_slope(j, n));
  glm::dvec3 normal = glm::cross(along_v, along_u);
  if (glm::length(normal) < 1e-9) {
    const glm::dvec3 mixed = evaluate(patch, bernstein_slope(i, n), bernstein_slope(j, n));
    normal = glm::cross(mixed, along_u) * (i == 0 ? 1.0 : -1.0);
  }
  return glm::normalize(normal) + 0.0;
}

bool is_bottom(const TeapotPatch& patch) {
  constexpr double kBottomHeight = 0.15;  // the body ends there; only the bottom's patches lie below
  for (const glm::dvec3& point : patch)
    if (point.z > kBottomHeight) return false;
  return true;
}

// The vertices so far, by place: several where the handle's end touches the body, which has another normal there.
class Vertices {
 public:
  explicit Vertices(Mesh& mesh) : mesh_(mesh) {}

  std::uint32_t find(const glm::dvec3& position, const glm::dvec3& normal) {
    const std::uint32_t place = places_.find(position);
    if (place == at_.size()) at_.emplace_back();
    for (const std::uint32_t vertex : at_[place])
      if (glm::length(mesh_.normals[vertex] - normal) < 1e-6) return vertex;  // one surface: they differ by rounding
    at_[place].push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
    return at_[place].back();
  }

 private:
  Mesh& mesh_;
  PointIndex places_;
  std::vector<std::vector<std::uint32_t>> at_;
};

void add_patch(Mesh& mesh, Vertices& vertices, const TeapotPatch& patch, std::size_t n) {
  std::vector<std::uint32_t> grid;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      grid.push_back(
          vertices.find(surface_point(patch, bernstein(i, n), bernstein(j, n)), patch_normal(patch, i, j, n)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::uint32_t a = grid[i * (n + 1) + j];
      const std::uint32_t b = grid[i * (n + 1) + j + 1];
      const std::uint32_t c = grid[(i + 1) * (n + 1) + j + 1];
      const std::uint32_t d = grid[(i + 1) * (n + 1) + j];
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
}

}  // namespace

Mesh teapot(std::size_t segments, std::size_t patches) {
  Mesh mesh;
  Vertices vertices(mesh);
  for (const TeapotPatch& patch : kNewellTeapot)
    if (patches == kTeapotPatches || !is_bottom(patch)) add_patch(mesh, vertices, patch, segments);
  mesh.degenerate = count_degenerate(mesh);
  return mesh;
}

Mesh uv_sphere(double radius, std::size_t slices, std::size_t stacks) {
  Mesh mesh;
  const auto add = [&](const glm::dvec3& normal) {
    mesh.positions.push_back(radius * normal);
    mesh.normals.push_back(normal);
  };
  add({0.0, 0.0, 1.0});
  for (std::size_t k = 1; k < stacks; ++k) {
    const double colatitude = 180.0 * static_cast<double>(k) / static_cast<double>(stacks);
    for (std::size_t j = 0; j < slices; ++j) {
      const double azimuth = 360.0 * static_cast<double>(j) / static_cast<double>(slices);
      const double ring = mathematics::sin_deg(colatitude);
      add({ring * mathematics::cos_deg(azimuth), ring * mathematics::sin_deg(azimuth),
           mathematics::cos_deg(colatitude)});
    }
  }
  add({0.0, 0.0, -1.0});
  const auto south = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  const auto at = [&](std::size_t k, std::size_t j) {  // ring k = 1..stacks-1
    return static_cast<std::uint32_t>(1 + (k - 1) * slices + j % slices);
  };
  for (std::size_t j = 0; j < slices; ++j) mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
  for (std::size_t k = 1; k + 1 < stacks; ++k)
    for (std::size_t j = 0; j < slices; ++j) {
      mesh.triangles.push_back({at(k, j), at(k + 1, j), at(k + 1, j + 1)});
      mesh.triangles.push_back({at(k, j), at(k + 1, j + 1), at(k, j + 1)});
    }
  for (std::size_t j = 0; j < slices; ++j) mesh.triangles.push_back({at(stacks - 1, j), south, at(stacks - 1, j + 1)});
  mesh.degenerate = count_degenerate(mesh);
  return mesh;
}

}  // namespace rastertlm::scene
