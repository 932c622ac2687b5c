// Triangles, meshes and an independent statement of coverage for the tests of set-up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "modules/set_up/triangle_set_up.h"
#include "src/base/fixed_point.h"
#include "src/geometry/snapping.h"

namespace rastertlm::set_up::test {

using Corner = geometry::ScreenVertex<double>;
using Triangle = ScreenTriangle<double>;
using Points = std::array<geometry::SnappedPoint, 3>;

inline Points snapped(const Triangle& triangle, int q) {
  const double scale = std::ldexp(1.0, q);
  Points points;
  for (std::size_t i = 0; i < 3; ++i)
    points[i] = {static_cast<std::int64_t>(std::floor(triangle[i].x * scale + 0.5)),
                 static_cast<std::int64_t>(std::floor(triangle[i].y * scale + 0.5))};
  return points;
}

// Columns [begin, end) that a triangle covers on a line, by the crossings of its sides with the line: a side counts
// from its upper end, included, to its lower, and a sample on a crossing lies right of it. That is the top-left rule.
struct Span {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

inline Span crossed_span(const Points& points, int q, std::int64_t line) {
  const std::int64_t one = std::int64_t{1} << q;
  const std::int64_t y = line * one;
  std::vector<std::int64_t> crossings;  // the first column at or right of each
  for (std::size_t i = 0; i < 3; ++i) {
    geometry::SnappedPoint a = points[i];
    geometry::SnappedPoint b = points[(i + 1) % 3];
    if (a.y > b.y) std::swap(a, b);
    if (y < a.y || y >= b.y) continue;
    const std::int64_t height = b.y - a.y;
    crossings.push_back(ceil_div(a.x * height + (b.x - a.x) * (y - a.y), height * one));
  }
  if (crossings.size() != 2) return {};
  return {std::min(crossings[0], crossings[1]), std::max(crossings[0], crossings[1])};
}

// The word of an EP1 on a pixel, A x + B (y + 1) + C' modulo 2^bits.
inline std::uint64_t word_at(const LinearWords& words, std::uint64_t x, std::uint64_t y, int bits) {
  return (words.a * x + words.b * (y + 1) + words.c) & ((std::uint64_t{1} << bits) - 1);
}
inline bool negative(std::uint64_t word, int bits) { return (word >> (bits - 1) & 1U) != 0; }
inline bool covers(const object_processor::TriangleWords& words, std::uint64_t x, std::uint64_t y, int bits) {
  for (const LinearWords& edge : words.edges)
    if (negative(word_at(edge, x, y, bits), bits)) return false;
  return true;
}

// Whether an edge's value stays inside the word on the whole screen: it is linear, so its corners tell.
inline bool wraps_on_screen(const LinearWords& words, const WordFormat& format) {
  const auto bits = static_cast<unsigned>(format.word_bits);
  const std::int64_t a = sign_extend(words.a, bits);
  const std::int64_t b = sign_extend(words.b, bits);
  const std::int64_t c = sign_extend((words.c + words.b) & low_mask(bits), bits);
  const std::int64_t limit = std::int64_t{1} << (bits - 1);
  for (const std::int64_t x : {std::int64_t{0}, static_cast<std::int64_t>(format.columns) - 1})
    for (const std::int64_t y : {std::int64_t{0}, static_cast<std::int64_t>(format.lines) - 1})
      if (std::abs(a * x + b * y + c) >= limit) return true;
  return false;
}

inline geometry::Viewport viewport(const WordFormat& format) { return {format.columns, format.lines}; }

// Families of triangles that stress the edges differently.
enum class Family { small, hundred, full_screen, partly_off, far_off, sliver };
inline constexpr std::array kOnScreen{Family::small, Family::hundred, Family::full_screen, Family::sliver};
inline constexpr std::array kAll{Family::small,      Family::hundred, Family::full_screen,
                                 Family::partly_off, Family::far_off, Family::sliver};

class Generator {
 public:
  explicit Generator(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool coin() { return std::uniform_int_distribution<int>(0, 1)(engine_) == 1; }

  // Corners of the family on a screen of n x n; on the screen but for the two families that leave it.
  Triangle triangle(Family family, double n) {
    Triangle t;
    switch (family) {
      case Family::small:
        around(t, n, 16.0);
        break;
      case Family::hundred:
        around(t, n, 100.0);
        break;
      case Family::full_screen:
        box(t, 0.0, n - 1);
        break;
      case Family::partly_off:
        box(t, -0.45 * n, 1.45 * n);
        break;
      case Family::far_off:
        box(t, -16.0 * n, 16.0 * n);
        break;
      case Family::sliver:
        sliver(t, n);
        break;
    }
    for (Corner& corner : t) {
      const double kind = uniform(0.0, 3.0);  // on the near plane, on the far plane, between
      corner.z = kind < 1.0 ? 0.0 : kind < 2.0 ? 1.0 : uniform(0.0, 1.0);
      for (int i = 0; i < 3; ++i) corner.normal[i] = uniform(-1.0, 1.0);
    }
    return t;
  }

 private:
  void box(Triangle& t, double low, double high) {
    for (Corner& corner : t) corner.x = uniform(low, high), corner.y = uniform(low, high);
  }
  void around(Triangle& t, double n, double size) {
    const double x = uniform(0.0, n - 1 - size);
    const double y = uniform(0.0, n - 1 - size);
    for (Corner& corner : t) corner.x = x + uniform(0.0, size), corner.y = y + uniform(0.0, size);
  }
  void sliver(Triangle& t, double n) {
    constexpr double kAspect = 1000.0;
    box(t, 1.0, n - 2);
    const double dx = t[1].x - t[0].x;
    const double dy = t[1].y - t[0].y;
    const double along = uniform(0.0, 1.0);
    t[2].x = t[0].x + along * dx - dy / kAspect;
    t[2].y = t[0].y + along * dy + dx / kAspect;
  }
  std::mt19937 engine_;
};

// A screen point as a clip-space vertex of an orthographic view.
inline geometry::ClipVertex<double> to_clip(const Corner& corner, const WordFormat& format) {
  const auto columns = static_cast<double>(format.columns);
  const auto lines = static_cast<double>(format.lines);
  return {{(corner.x + 0.5) * 2.0 / columns - 1.0, 1.0 - (corner.y + 0.5) * 2.0 / lines, corner.z, 1.0}, corner.normal};
}

// A sphere of slices x stacks about the origin with shared vertices: 2 slices (stacks - 1) triangles, counter-clockwise
// from outside. Tilted, so that no edge runs along the screen.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<std::array<std::size_t, 3>> triangles;

  // The radius of the largest ball about the origin inside a convex mesh.
  double inner_radius() const {
    double radius = 1e300;
    for (const auto& t : triangles) {
      const glm::dvec3 n =
          glm::normalize(glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]));
      radius = std::min(radius, glm::dot(n, positions[t[0]]));
    }
    return radius;
  }
};

inline Mesh uv_sphere(std::size_t slices, std::size_t stacks) {
  const double pi = std::acos(-1.0);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.8, 0.5));
  const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
  const glm::dvec3 v = glm::cross(axis, u);
  Mesh mesh;
  mesh.positions.push_back(axis);
  for (std::size_t stack = 1; stack < stacks; ++stack)
    for (std::size_t slice = 0; slice < slices; ++slice) {
      const double theta = pi * static_cast<double>(stack) / static_cast<double>(stacks);
      const double phi = 2 * pi * static_cast<double>(slice) / static_cast<double>(slices);
      mesh.positions.push_back(axis * std::cos(theta) + (u * std::cos(phi) + v * std::sin(phi)) * std::sin(theta));
    }
  mesh.positions.push_back(-axis);
  const auto ring = [slices](std::size_t stack, std::size_t slice) {
    return 1 + (stack - 1) * slices + slice % slices;
  };
  const std::size_t bottom = mesh.positions.size() - 1;
  for (std::size_t slice = 0; slice < slices; ++slice) {
    mesh.triangles.push_back({0, ring(1, slice), ring(1, slice + 1)});
    for (std::size_t stack = 1; stack + 1 < stacks; ++stack) {
      mesh.triangles.push_back({ring(stack, slice), ring(stack + 1, slice), ring(stack + 1, slice + 1)});
      mesh.triangles.push_back({ring(stack, slice), ring(stack + 1, slice + 1), ring(stack, slice + 1)});
    }
    mesh.triangles.push_back({ring(stacks - 1, slice), bottom, ring(stacks - 1, slice + 1)});
  }
  return mesh;
}

}  // namespace rastertlm::set_up::test
