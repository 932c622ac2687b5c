// Triangles for the pixel unit, their pixels by the sign of three areas, and what lights see of a pixel by its shares
// of the corners: nothing of this is stepped from pixel to pixel.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "modules/pixel_unit/pixel_shader.h"

namespace rastertlm::pixel_unit::test {

inline constexpr int kFractionBits = 4;

struct SeenPixel {
  glm::dvec3 normal{0.0};  // unit
  glm::dvec3 position{0.0};
};

inline glm::dvec2 pixel_of(const set_up::LitPoint& corner, int fraction_bits = kFractionBits) {
  return glm::dvec2(corner.at.x, corner.at.y) / std::ldexp(1.0, fraction_bits);
}

// Of a point on the screen, its shares of the corners; they add up to 1.
inline glm::dvec3 shares(const PixelTriangle& triangle, const glm::dvec2& at) {
  const auto corner = [&](std::size_t i) { return pixel_of(triangle.corners[i], triangle.fraction_bits); };
  const auto area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  };
  return glm::dvec3(area(at, corner(1), corner(2)), area(corner(0), at, corner(2)), area(corner(0), corner(1), at)) /
         area(corner(0), corner(1), corner(2));
}

inline SeenPixel seen_at(const PixelTriangle& triangle, const glm::dvec2& at, bool perspective) {
  glm::dvec3 share = shares(triangle, at);
  if (perspective) {
    for (int i = 0; i < 3; ++i) share[i] *= triangle.corners[static_cast<std::size_t>(i)].inverse_w;
    share /= share.x + share.y + share.z;
  }
  SeenPixel seen;
  for (int i = 0; i < 3; ++i) {
    seen.normal += share[i] * triangle.corners[static_cast<std::size_t>(i)].normal;
    seen.position += share[i] * triangle.corners[static_cast<std::size_t>(i)].position;
  }
  seen.normal = glm::normalize(seen.normal);
  return seen;
}

// The pixels inside, a span a line.
inline std::vector<span_unit::Span> spans_of(const PixelTriangle& triangle, std::uint32_t size = 96) {
  std::vector<span_unit::Span> spans;
  for (std::uint32_t line = 0; line < size; ++line) {
    span_unit::Span span;
    span.line = line;
    for (std::uint32_t column = 0; column < size; ++column) {
      const glm::dvec3 share = shares(triangle, {column, line});
      if (share.x < 0 || share.y < 0 || share.z < 0) continue;
      if (span.count++ == 0) span.column = column;
    }
    if (span.count > 0) spans.push_back(span);
  }
  return spans;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 direction() {
    return glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + glm::dvec3(1e-3));
  }
  // Of some size, its normals less than a right angle from each other and of any length near 1.
  PixelTriangle triangle() {
    PixelTriangle made;
    made.fraction_bits = kFractionBits;
    const glm::dvec3 normal = direction();
    do {
      for (set_up::LitPoint& corner : made.corners)
        corner.at = {static_cast<std::int64_t>(uniform(0, 95 << kFractionBits)),
                     static_cast<std::int64_t>(uniform(0, 95 << kFractionBits))};
    } while (std::abs(geometry::doubled_area(made.corners[0].at, made.corners[1].at, made.corners[2].at)) < 50000);
    for (set_up::LitPoint& corner : made.corners) {
      corner.normal = uniform(0.5, 1.5) * glm::normalize(normal + 0.5 * direction());
      corner.position = glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-6, -3));
      corner.inverse_w = uniform(0.1, 1.0);
    }
    return made;
  }

 private:
  std::mt19937_64 random_;
};

inline geometry::LightSource far_light(const glm::dvec3& towards) {
  return {false, glm::normalize(towards), glm::dvec3(0.4, 0.5, 0.6), glm::dvec3(0.7, 0.6, 0.5)};
}
inline geometry::LightSource near_light(const glm::dvec3& position) {
  return {true, position, glm::dvec3(0.4, 0.3, 0.2), glm::dvec3(0.2, 0.3, 0.4)};
}

}  // namespace rastertlm::pixel_unit::test
