// Pseudo-Phong: as many lights and triangles as its depth says, lit at their corners as the surface is, without a crack
// and without a double pixel, and the nearer to Phong the deeper.
#include "modules/set_up/midpoint_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "modules/set_up/span_load.h"
#include "modules/set_up/triangle_colourer.h"
#include "modules/span_unit/span_unit.h"

namespace rastertlm::set_up::test {
namespace {

const std::vector<geometry::Reflectance> kSurfaces{{glm::dvec3(0.05), glm::dvec3(0.5), glm::dvec3(0.3), 10}};
const std::vector<geometry::LightSource> kLights{
    {false, glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), glm::dvec3(1.0, 0.9, 0.8), glm::dvec3(1.0)},
    {true, glm::dvec3(2.0, 1.0, 3.0), glm::dvec3(0.3), glm::dvec3(0.2)}};
constexpr std::uint32_t kSize = 64;

struct Colouring {
  SetUpParameters parameters;
  PointLighting lighting;
  TriangleColourer colourer;
  std::vector<ColourTriangle> drawn;

  explicit Colouring(std::int64_t depth)
      : parameters(with(depth)), lighting(parameters, kSurfaces, {}), colourer(parameters, lighting) {
    lighting.set_lights(kLights, false);
    colourer.colour(request(depth), drawn);
  }
  static SetUpParameters with(std::int64_t depth) {
    SetUpParameters parameters;
    parameters.method = ShadingMethod::pseudo_phong;
    parameters.halvings = depth;
    parameters.clamp_knots = false;
    return parameters;
  }
  static ColourRequest request(std::int64_t depth) {
    ColourRequest request;
    const double at[3][2] = {{3.25, 60.5}, {58.0, 41.75}, {20.5, 2.0}};
    const glm::dvec3 normals[] = {{-0.5, -0.4, 1}, {0.6, -0.1, 1}, {-0.1, 0.5, 0.9}};
    for (std::size_t i = 0; i < 3; ++i) {
      const double scale = std::ldexp(16.0, static_cast<int>(depth));
      request.corners[i].at = {std::llround(at[i][0] * scale), std::llround(at[i][1] * scale)};
      request.corners[i].normal = glm::normalize(normals[i]);
      request.corners[i].position = {at[i][0] / 32 - 1, 1 - at[i][1] / 32, -4.0 - 0.5 * static_cast<double>(i)};
    }
    request.depth = {1000.0, 9000.0, 4000.0};
    request.object = 1;
    return request;
  }
};

glm::dvec3 shares(const ColourRequest& request, int bits, const glm::dvec2& at) {
  const auto corner = [&](std::size_t i) {
    return glm::dvec2(request.corners[i].at.x, request.corners[i].at.y) / std::ldexp(1.0, bits);
  };
  const auto area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  };
  return glm::dvec3(area(at, corner(1), corner(2)), area(corner(0), at, corner(2)), area(corner(0), corner(1), at)) /
         area(corner(0), corner(1), corner(2));
}

glm::dvec3 phong(const ColourRequest& request, const glm::dvec3& share) {
  glm::dvec3 normal(0.0), position(0.0);
  for (int i = 0; i < 3; ++i) {
    normal += share[i] * request.corners[static_cast<std::size_t>(i)].normal;
    position += share[i] * request.corners[static_cast<std::size_t>(i)].position;
  }
  return 255.0 * geometry::illumination<double>(kSurfaces[0], kLights, {}, glm::normalize(normal), {0, 0, 1}, position);
}

// The paper's counts: (2^k + 1) (2^k + 2) / 2 lights, 4^k triangles.
TEST(MidpointGrid, LightsEachPointOnce) {
  const std::uint64_t lights[] = {3, 6, 15, 45, 153};
  for (std::int64_t depth = 0; depth < 5; ++depth) {
    const Colouring colouring(depth);
    EXPECT_EQ(colouring.lighting.counts().evaluations, lights[depth]);
    EXPECT_EQ(colouring.drawn.size(), std::size_t{1} << (2 * depth));
    EXPECT_EQ(colouring.colourer.counts().drawn, colouring.drawn.size());
    EXPECT_EQ(colouring.colourer.counts().splits, (colouring.drawn.size() - 1) / 3);
  }
}

TEST(MidpointGrid, CornersAreLitAsTheSurfaceThere) {
  for (const std::int64_t depth : {0, 1, 3}) {
    const Colouring colouring(depth);
    const ColourRequest request = Colouring::request(depth);
    for (const ColourTriangle& part : colouring.drawn)
      for (std::size_t i = 0; i < 3; ++i) {
        const double unit = std::ldexp(1.0, -part.fraction_bits);
        const glm::dvec2 at(static_cast<double>(part.corners[i].x) * unit,
                            static_cast<double>(part.corners[i].y) * unit);
        const glm::dvec2 from = at - glm::dvec2(part.corners[0].x, part.corners[0].y) * unit;
        const glm::dvec3 share = shares(request, part.fraction_bits, at);
        const glm::dvec3 wanted = phong(request, share);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(part.colour[static_cast<std::size_t>(c)].at(from.x, from.y), wanted[c], 1e-8);
        ASSERT_NEAR(part.depth[i], share.x * 1000 + share.y * 9000 + share.z * 4000, 1e-6);
      }
  }
}

// Each pixel of the whole triangle is one part's; and as far from Phong as a quarter of what it was a depth less.
TEST(MidpointGrid, PartsCoverTheWholeOnceAndComeNearer) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> whole;
  double last = 0.0;
  for (std::int64_t depth = 0; depth < 5; ++depth) {
    const Colouring colouring(depth);
    const ColourRequest request = Colouring::request(depth);
    const span_unit::SpanUnitParameters unit;
    span_unit::SpanUnit spans(unit, kSize, kSize);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> covered;
    double off = 0.0;
    for (const ColourTriangle& part : colouring.drawn)
      for (const span_unit::Span& span : spans.draw(span_load(part, SpanFormat::of(unit, kSize))).spans)
        for (std::uint32_t x = span.column; x < span.column + span.count; ++x) {
          ++covered[{span.line, x}];
          const double scale = std::ldexp(1.0, -part.fraction_bits);
          const glm::dvec2 from = glm::dvec2(x, span.line) - glm::dvec2(part.corners[0].x, part.corners[0].y) * scale;
          const glm::dvec3 wanted = phong(request, shares(request, part.fraction_bits, {x, span.line}));
          off = std::max(off, std::fabs(part.colour[0].at(from.x, from.y) - wanted.x));
        }
    if (depth == 0) whole = covered;
    EXPECT_EQ(covered, whole) << depth;
    for (const auto& [pixel, times] : covered) ASSERT_EQ(times, 1);
    // Of second order; where parts are still coarse beside the highlight, less regularly.
    if (depth > 1) {
      EXPECT_GT(last / off, 2.5) << depth;
      EXPECT_LT(last / off, 5.5) << depth;
    }
    last = off;
  }
  EXPECT_LT(last, 1.0);
}

}  // namespace
}  // namespace rastertlm::set_up::test
