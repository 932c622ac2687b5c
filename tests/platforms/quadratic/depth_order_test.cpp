// Depths in the wrong order are counted beyond what the machine's own depth words can be off by: is that so much, and
// no more than a few times what is seen?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "src/run/exact_pictures.h"
#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm::test {
namespace {

run::Inputs inputs_of(int fraction_bits, const std::string& start_edge = "lattice") {
  return sphere_inputs(
      "168", {"span_unit.depth_fraction_bits=" + std::to_string(fraction_bits), "span_unit.start_edge=" + start_edge});
}

double bound_of(const run::Inputs& inputs) {
  return run::depth_words(std::get<quadratic::Machine>(inputs.content->machine)).value().bound;
}

// The depth of the triangle's plane at a pixel, by the areas opposite to its corners.
double depth_at(const set_up::ColourTriangle& triangle, std::uint32_t column, std::uint32_t line) {
  const double unit = std::ldexp(1.0, -triangle.fraction_bits);
  std::array<double, 3> area{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = triangle.corners[(i + 1) % 3], &b = triangle.corners[(i + 2) % 3];
    const double ax = static_cast<double>(a.x) * unit - column, ay = static_cast<double>(a.y) * unit - line;
    const double bx = static_cast<double>(b.x) * unit - column, by = static_cast<double>(b.y) * unit - line;
    area[i] = ax * by - bx * ay;
  }
  const double whole = area[0] + area[1] + area[2];
  return (area[0] * triangle.depth[0] + area[1] * triangle.depth[1] + area[2] * triangle.depth[2]) / whole;
}

double farthest_off(const run::Inputs& inputs) {
  double farthest = 0.0;
  visit_spans(
      inputs, [&](const set_up::ColourTriangle& triangle, const span_unit::Span& span, const SpanPixels& pixels) {
        for (std::uint32_t x = 0; x < span.count; ++x)
          farthest = std::max(farthest, std::fabs(pixels.depths[x] - depth_at(triangle, span.column + x, span.line)));
      });
  return farthest;
}

TEST(DepthOrder, IsToleratedByWhatTheRegistersOfDepthCanBeOffBy) {
  for (const int bits : {4, 5, 6, 8}) {
    const run::Inputs inputs = inputs_of(bits);
    const double seen = farthest_off(inputs), bound = bound_of(inputs);
    EXPECT_LE(seen, bound) << bits;
    EXPECT_GT(seen, bound / 20) << bits;
  }
  // What is stored is floored, and 2048 steps round: 1 + 2049 / 2^9.
  EXPECT_DOUBLE_EQ(bound_of(inputs_of(8)), 1.0 + 2049.0 / 512.0);
  EXPECT_GT(bound_of(inputs_of(5)), 7 * (bound_of(inputs_of(8)) - 1.0));
}

TEST(DepthOrder, IsToleratedByTheMarginWhereTheStartEdgeIsOff) {
  EXPECT_EQ(bound_of(inputs_of(8, "published")), 257.0);
  EXPECT_EQ(bound_of(inputs_of(8, "prestep")), 257.0);
}

}  // namespace
}  // namespace rastertlm::test
