// Are there no T-junctions and no steps of colour where a machine stitches, and both where it does not?
//
// Everything is looked for among the triangles that are drawn, by brute force: what edges and corners they have in
// common is nowhere asked of the set-up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "tests/platforms/adaptive/set_up_frames.h"

namespace rastertlm::test {
namespace {

using geometry::SnappedPoint;
using set_up::ColourTriangle;

struct Corner {
  SnappedPoint at;
  double depth = 0.0;
};

// Corners inside another triangle's edge, at its depth: exactly on it on the grid.
std::size_t t_junctions(const std::vector<ColourTriangle>& triangles) {
  constexpr double kSameDepth = 1.0;  // in units of the depth word; those of other surfaces are thousands away
  std::vector<Corner> corners;
  for (const ColourTriangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) corners.push_back({t.corners[i], t.depth[i]});
  const auto left_of = [](const Corner& a, const Corner& b) {
    return std::tie(a.at.x, a.at.y) < std::tie(b.at.x, b.at.y);
  };
  std::sort(corners.begin(), corners.end(), left_of);
  std::size_t found = 0;
  for (const ColourTriangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      Corner a{t.corners[i], t.depth[i]}, b{t.corners[(i + 1) % 3], t.depth[(i + 1) % 3]};
      if (left_of(b, a)) std::swap(a, b);
      const auto first = std::lower_bound(corners.begin(), corners.end(), a, left_of);
      for (auto c = first; c != corners.end() && c->at.x <= b.at.x; ++c) {
        if (c->at == a.at || c->at == b.at || geometry::doubled_area(a.at, b.at, c->at) != 0) continue;
        if (c->at.y < std::min(a.at.y, b.at.y) || c->at.y > std::max(a.at.y, b.at.y)) continue;
        const double whole = std::hypot(b.at.x - a.at.x, b.at.y - a.at.y);
        const double share = std::hypot(c->at.x - a.at.x, c->at.y - a.at.y) / whole;
        found += std::fabs(a.depth + share * (b.depth - a.depth) - c->depth) < kSameDepth ? 1 : 0;
      }
    }
  return found;
}

struct Shared {
  std::size_t edges = 0;
  double largest_step = 0.0;  // levels
};

// Edges that two triangles have from end to end, and how far apart their colours are there: linear, so at the ends.
Shared shared_edges(const std::vector<ColourTriangle>& triangles) {
  struct Side {
    const ColourTriangle* triangle;
    double depth;
  };
  std::map<std::array<std::int64_t, 4>, std::vector<Side>> edges;
  for (const ColourTriangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      SnappedPoint a = t.corners[i], b = t.corners[(i + 1) % 3];
      if (std::tie(b.x, b.y) < std::tie(a.x, a.y)) std::swap(a, b);
      edges[{a.x, a.y, b.x, b.y}].push_back({&t, t.depth[i] + t.depth[(i + 1) % 3]});
    }
  const auto level = [](const ColourTriangle& t, std::size_t channel, std::int64_t x, std::int64_t y) {
    const double unit = std::ldexp(1.0, -t.fraction_bits);
    return t.colour[channel].at(static_cast<double>(x - t.corners[0].x) * unit,
                                static_cast<double>(y - t.corners[0].y) * unit);
  };
  Shared shared;
  for (const auto& [edge, sides] : edges)
    for (std::size_t one = 0; one < sides.size(); ++one)
      for (std::size_t other = one + 1; other < sides.size(); ++other) {
        if (std::fabs(sides[one].depth - sides[other].depth) > 2.0) continue;
        ++shared.edges;
        for (std::size_t channel = 0; channel < 3; ++channel)
          for (std::size_t end = 0; end < 4; end += 2)
            shared.largest_step = std::max(shared.largest_step,
                                           std::fabs(level(*sides[one].triangle, channel, edge[end], edge[end + 1]) -
                                                     level(*sides[other].triangle, channel, edge[end], edge[end + 1])));
      }
  return shared;
}

class Stitch : public testing::TestWithParam<const char*> {
 protected:
  static std::vector<SetUpFrame> frames(const std::string& method, const std::string& stitch) {
    return set_up_frames(adaptive_inputs({"set_up.method=" + method, "subdivision.stitch=" + stitch}), views());
  }
  static std::vector<std::int64_t> views() { return {0, 7, 19, 28, 41, 53}; }
};

TEST_P(Stitch, LeavesNoTJunctionAndNoStepOfColour) {
  const std::vector<SetUpFrame> whole = set_up_frames(adaptive_inputs({"set_up.method=gouraud"}), views());
  const std::vector<SetUpFrame> loose = frames(GetParam(), "false"), stitched = frames(GetParam(), "true");
  for (std::size_t f = 0; f < stitched.size(); ++f) {
    EXPECT_GT(t_junctions(loose[f].triangles), 50U);
    EXPECT_EQ(t_junctions(stitched[f].triangles), 0U) << "view " << views()[f];
    const Shared before = shared_edges(whole[f].triangles), after = shared_edges(stitched[f].triangles);
    EXPECT_GT(after.edges, before.edges + 300);
    EXPECT_LT(after.largest_step, 1e-9);
  }
}

// Parts are counted before they are stitched, as table 2 counts them, and corners that are had in common are lit once.
TEST_P(Stitch, AddsCornersWithoutLightingThem) {
  const std::vector<SetUpFrame> loose = frames(GetParam(), "false"), stitched = frames(GetParam(), "true");
  for (std::size_t f = 0; f < stitched.size(); ++f) {
    const host::SetUpCounts &a = loose[f].counts, &b = stitched[f].counts;
    EXPECT_EQ(a.stitched.triangles, 0U);
    EXPECT_GT(b.stitched.triangles, 20U);
    EXPECT_EQ(a.subdivision.parts, b.subdivision.parts);
    EXPECT_EQ(a.subdivision.divided, b.subdivision.divided);
    EXPECT_EQ(a.lighting.evaluations, b.lighting.evaluations);
    EXPECT_EQ(a.colour.drawn + b.stitched.corners, b.colour.drawn);
    EXPECT_EQ(a.facing, b.facing);
    EXPECT_EQ(a.back_faces, b.back_faces);
    EXPECT_GT(b.operations.integer, a.operations.integer);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Stitch, testing::Values("regular_subdivision", "highlight_subdivision"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace rastertlm::test
