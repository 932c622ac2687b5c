// Is each method exact where it claims to be, off by what it claims where it is not, and are its operations counted?
#include "modules/pixel_unit/pixel_shader.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tests/modules/pixel_unit/triangles.h"

namespace rastertlm::pixel_unit::test {
namespace {

using Lights = std::vector<geometry::LightSource>;
using set_up::Attributes;

const std::vector<geometry::Reflectance> kSurfaces{
    {glm::dvec3(0.05, 0.02, 0.1), glm::dvec3(0.2, 0.3, 0.4), glm::dvec3(0.2), 7},
    {glm::dvec3(0.1), glm::dvec3(0.1, 0.5, 0.1), glm::dvec3(0.3), 20}};

PixelShader shader_of(ShadingMethod method, const Lights& lights, const geometry::LightingRules& rules = {},
                      Attributes attributes = Attributes::linear, bool at_eye = false, bool count = false) {
  PixelShader shader({method, attributes, count}, kSurfaces, rules);
  shader.set_lights(lights, at_eye);
  return shader;
}

// Levels of a triangle's pixels, span after span.
std::vector<glm::dvec3> shaded(PixelShader& shader, const PixelTriangle& triangle) {
  std::vector<glm::dvec3> all, line;
  shader.set_up(triangle);
  for (const span_unit::Span& span : spans_of(triangle)) {
    shader.shade(span, line);
    all.insert(all.end(), line.begin(), line.end());
  }
  return all;
}

template <class Expected>
void expect_pixels(PixelShader& shader, const PixelTriangle& triangle, double tolerance, const Expected& expected) {
  std::vector<glm::dvec3> line;
  shader.set_up(triangle);
  for (const span_unit::Span& span : spans_of(triangle)) {
    shader.shade(span, line);
    ASSERT_EQ(line.size(), span.count);
    for (std::uint32_t n = 0; n < span.count; ++n) {
      const glm::dvec3 wanted = expected(glm::dvec2(span.column + n, span.line));
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(line[n][c], wanted[c], tolerance) << span.column + n << ", " << span.line;
    }
  }
}

glm::dvec3 lit(const PixelTriangle& triangle, const Lights& lights, const geometry::LightingRules& rules,
               const SeenPixel& seen, bool at_eye) {
  const glm::dvec3 viewer = at_eye ? glm::normalize(-seen.position) : glm::dvec3(0, 0, 1);
  return 255.0 * geometry::illumination<double>(kSurfaces[triangle.material], lights, rules, seen.normal, viewer,
                                                seen.position);
}

TEST(PixelShader, PhongIsTheEquationAtEveryPixel) {
  Random random(1);
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (const bool gate : {false, true})
      for (const bool perspective : {false, true})
        for (const bool near : {false, true}) {
          const geometry::LightingRules rules{model, gate, glm::dvec3(0.8)};
          const Attributes attributes = perspective ? Attributes::perspective : Attributes::linear;
          for (int round = 0; round < 4; ++round) {
            Lights lights{far_light(random.direction()), far_light(random.direction())};
            if (near) lights.push_back(near_light(3.0 * random.direction()));
            PixelShader shader = shader_of(ShadingMethod::phong, lights, rules, attributes, near);
            PixelTriangle triangle = random.triangle();
            triangle.material = static_cast<std::size_t>(round % 2);
            EXPECT_EQ(shader.needs_positions(), near);
            expect_pixels(shader, triangle, 1e-8, [&](const glm::dvec2& at) {
              return lit(triangle, lights, rules, seen_at(triangle, at, perspective), near && perspective);
            });
          }
        }
}

TEST(PixelShader, TheQuotientIsPhongWhereLightsAndViewerAreFar) {
  Random random(2);
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (const Attributes attributes : {Attributes::linear, Attributes::perspective})
      for (int round = 0; round < 6; ++round) {
        const geometry::LightingRules rules{model, round % 2 == 1, glm::dvec3(1.0)};
        const Lights lights{far_light(random.direction()), far_light(random.direction())};
        const PixelTriangle triangle = random.triangle();
        PixelShader duff = shader_of(ShadingMethod::duff, lights, rules, attributes);
        expect_pixels(duff, triangle, 1e-8, [&](const glm::dvec2& at) {
          return lit(triangle, lights, rules, seen_at(triangle, at, attributes == Attributes::perspective), false);
        });
      }
}

// The rule for light at a point and a near viewer: as the triangle's centre sees them.
TEST(PixelShader, TheQuotientSeesLightsFromTheCentre) {
  Random random(3);
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (const bool perspective : {false, true}) {
      const geometry::LightingRules rules{model, false, glm::dvec3(1.0)};
      const Lights lights{far_light(random.direction()), near_light(3.0 * random.direction())};
      const PixelTriangle triangle = random.triangle();
      PixelShader duff = shader_of(ShadingMethod::duff, lights, rules,
                                   perspective ? Attributes::perspective : Attributes::linear, perspective);
      glm::dvec2 middle(0.0);
      for (const set_up::LitPoint& corner : triangle.corners) middle += pixel_of(corner) / 3.0;
      const glm::dvec3 centre = seen_at(triangle, middle, perspective).position;
      expect_pixels(duff, triangle, 1e-8, [&](const glm::dvec2& at) {
        SeenPixel seen = seen_at(triangle, at, perspective);
        seen.position = centre;
        return lit(triangle, lights, rules, seen, perspective);
      });
    }
}

TEST(PixelShader, TheSeriesIsExactWhereTheQuotientIsAQuadratic) {
  Random random(4);
  const Lights lights{far_light({0.2, 0.3, 1.0}), far_light({-0.5, 0.1, 0.4})};
  for (int round = 0; round < 10; ++round) {
    PixelTriangle triangle = random.triangle();
    // One direction, lengths that differ: the normal's derivatives are not zero, the quotient's are.
    for (set_up::LitPoint& corner : triangle.corners) corner.normal = {0.1, -0.2, 0.9};
    triangle.corners[1].normal *= random.uniform(0.5, 2.0);
    triangle.corners[2].normal *= random.uniform(0.5, 2.0);
    PixelShader taylor = shader_of(ShadingMethod::taylor, lights);
    expect_pixels(taylor, triangle, 1e-8,
                  [&](const glm::dvec2& at) { return lit(triangle, lights, {}, seen_at(triangle, at, false), false); });
  }
}

// Third-order remainder: half the triangle on the same surface is off by an eighth. Its normals differ by half as much;
// on the screen it is drawn as large, so that the same pixels are looked at.
TEST(PixelShader, TheSeriesIsOffByAnEighthInHalfTheTriangle) {
  const Lights lights{far_light({0.2, 0.3, 1.0})};
  Random random(12);
  PixelTriangle triangle = random.triangle();
  const glm::dvec3 mean(0.1, 0.05, 1.0);
  const glm::dvec3 across[] = {{-0.3, -0.1, 0.02}, {0.25, -0.15, -0.03}, {0.05, 0.25, 0.01}};  // adds up to zero
  double last = 0.0;
  for (const double size : {0.125, 0.0625, 0.03125, 0.015625}) {
    for (std::size_t i = 0; i < 3; ++i) triangle.corners[i].normal = mean + size * across[i];
    PixelShader taylor = shader_of(ShadingMethod::taylor, lights), phong = shader_of(ShadingMethod::phong, lights);
    const std::vector<glm::dvec3> a = shaded(taylor, triangle), b = shaded(phong, triangle);
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::fabs(a[i].x - b[i].x));
    if (last > 0.0) {
      EXPECT_GT(last / off, 7.2) << size;
      EXPECT_LT(last / off, 8.8) << size;
    }
    last = off;
  }
  EXPECT_GT(last, 1e-7);
}

// Two triangles with a common edge, and a pixel on it.
TEST(PixelShader, TheSeriesAloneJumpsAcrossAnEdge) {
  PixelTriangle left, right;
  left.fraction_bits = right.fraction_bits = kFractionBits;
  const auto corner = [](double x, double y, const glm::dvec3& normal) {
    set_up::LitPoint made;
    made.at = {std::llround(x * 16), std::llround(y * 16)};
    made.normal = glm::normalize(normal);
    return made;
  };
  const set_up::LitPoint top = corner(40, 8, {0.1, 0.5, 1}), bottom = corner(40, 72, {0.0, -0.4, 1});
  left.corners = {top, bottom, corner(5, 30, {-1.6, 0, 1})};
  right.corners = {top, bottom, corner(80, 50, {0.5, 0.9, 1})};
  const Lights lights{far_light({0.1, 0.2, 1.0})};
  span_unit::Span span;
  span.column = 40;
  span.line = 41;
  span.count = 1;
  const auto jump = [&](ShadingMethod method) {
    PixelShader shader = shader_of(method, lights);
    std::vector<glm::dvec3> a, b;
    shader.set_up(left);
    shader.shade(span, a);
    shader.set_up(right);
    shader.shade(span, b);
    return std::fabs(a[0].x - b[0].x);
  };
  EXPECT_LT(jump(ShadingMethod::phong), 1e-9);
  EXPECT_LT(jump(ShadingMethod::duff), 1e-9);
  EXPECT_LT(jump(ShadingMethod::angular), 1e-9);
  EXPECT_GT(jump(ShadingMethod::taylor), 0.5);
}

// Normals on a great circle whose angle is linear on the screen: a cylinder seen from far.
TEST(PixelShader, AnglesAreExactOnAGreatCircle) {
  Random random(6);
  const Lights lights{far_light({0.3, 0.2, 1.0}), far_light({-0.6, 0.1, 0.5})};
  for (int round = 0; round < 10; ++round) {
    PixelTriangle triangle = random.triangle();
    const double ax = random.uniform(-0.012, 0.012), ay = random.uniform(-0.012, 0.012);
    const auto normal = [&](const glm::dvec2& at) {
      const double angle = ax * (at.x - 48) + ay * (at.y - 48);
      return glm::dvec3(std::sin(angle), 0.0, std::cos(angle));
    };
    for (set_up::LitPoint& corner : triangle.corners) corner.normal = normal(pixel_of(corner));
    PixelShader angular = shader_of(ShadingMethod::angular, lights);
    expect_pixels(angular, triangle, 1e-8, [&](const glm::dvec2& at) {
      return lit(triangle, lights, {}, SeenPixel{normal(at), {}}, false);
    });
  }
}

glm::dvec3 turned(const glm::dvec3& a, const glm::dvec3& b, double share) {
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  return (std::sin((1 - share) * angle) * a + std::sin(share * angle) * b) / std::sin(angle);
}

// Of any normals: along the edges, and then along the line.
TEST(PixelShader, AnglesGrowEvenlyOnEdgesAndLines) {
  Random random(7);
  for (const geometry::Model model : {geometry::Model::blinn, geometry::Model::phong})
    for (int round = 0; round < 8; ++round) {
      const geometry::LightingRules rules{model, false, glm::dvec3(1.0)};
      const Lights lights{far_light(random.direction()), far_light(random.direction())};
      const PixelTriangle triangle = random.triangle();
      PixelShader angular = shader_of(ShadingMethod::angular, lights, rules);
      const auto normal = [&](const glm::dvec2& at) {
        std::vector<std::pair<double, glm::dvec3>> ends;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto &from = triangle.corners[i], &to = triangle.corners[(i + 1) % 3];
          const glm::dvec2 a = pixel_of(from), b = pixel_of(to);
          if (a.y == b.y || at.y < std::min(a.y, b.y) || at.y > std::max(a.y, b.y)) continue;
          const double share = (at.y - a.y) / (b.y - a.y);
          ends.emplace_back(a.x + share * (b.x - a.x),
                            turned(glm::normalize(from.normal), glm::normalize(to.normal), share));
        }
        const auto [first, last] = std::minmax_element(ends.begin(), ends.end(),
                                                       [](const auto& a, const auto& b) { return a.first < b.first; });
        if (last->first - first->first < 1e-9) return first->second;
        return turned(first->second, last->second, (at.x - first->first) / (last->first - first->first));
      };
      expect_pixels(angular, triangle, 1e-7, [&](const glm::dvec2& at) {
        return lit(triangle, lights, rules, SeenPixel{normal(at), {}}, false);
      });
    }
}

// Dot products of a pixel, where no light is on it: what is left of the equation is two comparisons a light and the
// scale of three channels.
TEST(PixelShader, CountsWhatAPixelTakes) {
  Random random(8);
  const PixelTriangle triangle = random.triangle();
  glm::dvec3 behind(0.0);
  for (const set_up::LitPoint& corner : triangle.corners) behind -= corner.normal;
  // Away from the viewer too, so that H is behind as well.
  const Lights lights{far_light(behind), far_light(behind + glm::dvec3(0.01, 0, 0)), far_light(behind)};
  const std::uint64_t dots = lights.size() + 1;  // Phong's model: the viewer's is shared
  for (const ShadingMethod method :
       {ShadingMethod::phong, ShadingMethod::duff, ShadingMethod::taylor, ShadingMethod::angular}) {
    const geometry::LightingRules rules{geometry::Model::phong, true, glm::dvec3(1.0)};
    PixelShader shader = shader_of(method, lights, rules, Attributes::linear, false, true);
    PixelShader plain = shader_of(method, lights, rules);
    EXPECT_EQ(shaded(shader, triangle), shaded(plain, triangle));
    const ShaderCounters& counters = shader.counters();
    EXPECT_EQ(plain.counters().pixel, geometry::OperationCounts{});
    const std::uint64_t pixels = counters.pixels, steps = counters.pixels - counters.lines;
    geometry::OperationCounts wanted;
    wanted.multiply = pixels * (3 + 2 * lights.size());  // scale; 2 (N.L) (N.V) - L.V
    wanted.add = pixels * lights.size();
    wanted.compare = pixels * 2 * lights.size();
    if (method == ShadingMethod::phong) {
      wanted.add += 3 * steps + pixels * (2 + 2 * dots);
      wanted.multiply += pixels * (3 + 3 + 3 * dots);
      wanted.compare += pixels;
      wanted.square_root += pixels;
      wanted.divide += pixels;
    } else if (method == ShadingMethod::duff) {
      wanted.add += steps * (2 + dots);
      wanted.compare += pixels;
      wanted.square_root += pixels;
      wanted.divide += pixels * dots;
    } else if (method == ShadingMethod::taylor) {
      wanted.add += steps * 2 * dots;
    } else {
      wanted.add += steps * dots;
      wanted.multiply += steps * dots;
    }
    EXPECT_EQ(counters.pixel, wanted) << traits_of(method).name;
    // A line's and a triangle's, by the README's table: a constant, and a share for every dot product.
    struct Share {
      std::uint64_t all, each;
    };
    const auto expect = [&](std::uint64_t counted, std::uint64_t times, const Share& share) {
      EXPECT_EQ(counted, times * (share.all + dots * share.each)) << traits_of(method).name;
    };
    const std::size_t row = method == ShadingMethod::phong    ? 0
                            : method == ShadingMethod::duff   ? 1
                            : method == ShadingMethod::taylor ? 2
                                                              : 3;
    const Share line_add[] = {{6, 0}, {8, 2}, {2, 8}, {112, 7}}, line_multiply[] = {{8, 0}, {8, 2}, {2, 6}, {126, 12}};
    const Share add[] = {{15, 0}, {30, 6}, {36, 18}, {57, 0}}, multiply[] = {{24, 0}, {42, 9}, {49, 35}, {99, 0}};
    const Share divide[] = {{1, 0}, {1, 0}, {2, 0}, {9, 0}};
    expect(counters.line.add, counters.lines, line_add[row]);
    expect(counters.line.multiply, counters.lines, line_multiply[row]);
    expect(counters.set_up.add, 1, add[row]);
    expect(counters.set_up.multiply, 1, multiply[row]);
    expect(counters.set_up.divide, 1, divide[row]);
    EXPECT_EQ(counters.line_angles, method == ShadingMethod::angular ? counters.lines * 9 : 0U);
    EXPECT_EQ(counters.set_up_angles, method == ShadingMethod::angular ? 3U : 0U);
  }
}

TEST(PixelShader, WithoutANormalThereIsAmbientLightAlone) {
  PixelTriangle triangle = Random(9).triangle();
  for (set_up::LitPoint& corner : triangle.corners) corner.normal = glm::dvec3(0.0);
  for (const ShadingMethod method :
       {ShadingMethod::phong, ShadingMethod::duff, ShadingMethod::taylor, ShadingMethod::angular}) {
    PixelShader shader = shader_of(method, {far_light({0, 0, 1})}, {geometry::Model::phong, false, glm::dvec3(1.0)});
    for (const glm::dvec3& level : shaded(shader, triangle))
      ASSERT_LT(glm::distance(level, 255.0 * kSurfaces[0].ambient), 1e-9) << traits_of(method).name;
    EXPECT_EQ(shader.counters().vanishing, method == ShadingMethod::taylor ? 1U : 0U);
  }
}

TEST(PixelShader, OppositeNormalsAndNumbersThatAreNoneGiveLevels) {
  PixelTriangle triangle = Random(10).triangle();
  triangle.corners[1].normal = -triangle.corners[0].normal;
  Lights lights{far_light({0, 0.3, 1})};
  std::vector<std::uint32_t> levels;
  for (const ShadingMethod method :
       {ShadingMethod::phong, ShadingMethod::duff, ShadingMethod::taylor, ShadingMethod::angular}) {
    PixelShader shader = shader_of(method, lights);
    shaded(shader, triangle);
    EXPECT_EQ(shader.counters().not_finite, 0U) << traits_of(method).name;
    lights[0].diffuse_intensity.y = std::numeric_limits<double>::quiet_NaN();
    PixelShader broken = shader_of(method, lights);
    lights[0].diffuse_intensity.y = 0.5;
    broken.set_up(triangle);
    for (const span_unit::Span& span : spans_of(triangle)) broken.shade(span, levels);
    EXPECT_GT(broken.counters().not_finite, 0U);
  }
  EXPECT_THROW(shader_of(ShadingMethod::gouraud, lights), std::invalid_argument);
}

// Rounded half up and clamped, red in the low byte.
TEST(PixelShader, RoundsAndClampsLevels) {
  const Lights lights{far_light({0, 0, 1}), far_light({0.1, 0, 1}), far_light({0, 0.1, 1})};
  Random random(11);
  PixelTriangle triangle = random.triangle();
  triangle.material = 1;
  for (set_up::LitPoint& corner : triangle.corners) corner.normal = random.direction() + glm::dvec3(0, 0, 1.2);
  PixelShader shader = shader_of(ShadingMethod::phong, lights);
  shader.set_up(triangle);
  std::vector<glm::dvec3> exact;
  std::vector<std::uint32_t> levels;
  bool clamped = false;
  for (const span_unit::Span& span : spans_of(triangle)) {
    shader.shade(span, exact);
    shader.shade(span, levels);
    for (std::size_t n = 0; n < exact.size(); ++n)
      for (int c = 0; c < 3; ++c) {
        clamped |= exact[n][c] > 255.0;
        ASSERT_EQ(levels[n] >> (8 * c) & 0xFFU,
                  static_cast<std::uint32_t>(std::floor(std::clamp(exact[n][c], 0.0, 255.0) + 0.5)));
      }
  }
  EXPECT_TRUE(clamped);
}

}  // namespace
}  // namespace rastertlm::pixel_unit::test
