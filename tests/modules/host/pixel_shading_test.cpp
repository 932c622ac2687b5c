// A host in front of a pixel unit: which triangles it gives to it, with the same pixels and depths as any other's, and
// what that costs instead of light at corners.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "modules/host/set_up_work.h"
#include "modules/span_unit/span_unit.h"
#include "tests/modules/host/resident_world.h"

namespace rastertlm::host {
namespace {

struct Drawn {
  span_unit::TriangleLoad load;
  std::uint64_t words = 0;
  std::vector<span_unit::Span> spans;
  std::vector<glm::dvec3> levels;  // of a shaded one, span after span
};

struct Host {
  set_up::SetUpParameters parameters;
  SetUpFormat format;
  span_unit::SpanUnitParameters unit;
  SetUpWork work;
  std::vector<Drawn> drawn;

  Host(const World& world, ShadingMethod method, const geometry::LightingRules& rules = {},
       set_up::Attributes attributes = set_up::Attributes::perspective)
      : parameters(with(method, attributes)),
        format{{kColumns, kLines}, 24, set_up::SpanFormat::of({}, kLines)},
        work(world.resident, parameters, format, surfaces(), rules) {
    work.begin_frame(world.pose(0), true);
    span_unit::SpanUnit spans(unit, kColumns, kLines);
    while (work.next())
      for (const span_unit::TriangleLoad& load : work.loads()) {
        Drawn& one = drawn.emplace_back();
        one.load = load;
        one.words = work.words_of(load).total();
        const auto lines = spans.draw(load).spans;
        one.spans.assign(lines.begin(), lines.end());
        if (load.shading == nullptr) continue;
        work.shader()->set_up(*load.shading);
        std::vector<glm::dvec3> line;
        for (const span_unit::Span& span : one.spans) {
          work.shader()->shade(span, line);
          one.levels.insert(one.levels.end(), line.begin(), line.end());
        }
      }
  }
  static set_up::SetUpParameters with(ShadingMethod method, set_up::Attributes attributes) {
    set_up::SetUpParameters parameters;
    parameters.method = method;
    parameters.attributes = attributes;
    parameters.rings = 0;
    return parameters;
  }
  static std::vector<geometry::Reflectance> surfaces() {
    return std::vector<geometry::Reflectance>(16, {glm::dvec3(0.1), glm::dvec3(0.5), glm::dvec3(0.4), 12});
  }
};

void fill(World& world, bool two_sided = false) {
  std::mt19937 random(7);
  geometry::Mesh& mesh = world.add(two_sided, false);
  add_random_triangles(mesh, 60, 4.0, random);
  // Between two lines of the screen: nothing is loaded.
  add_triangle(mesh, {-1, 0.02, 0}, {1, 0.02, 0}, {0, 0.06, 0});
  world.places = {{glm::dvec3(0, 0, -11)}};
}

std::uint64_t sum_of_words(const std::vector<Drawn>& drawn) {
  std::uint64_t words = 0;
  for (const Drawn& one : drawn) words += one.words;
  return words;
}

void expect_same_pixels(const Drawn& a, const Drawn& b) {
  ASSERT_EQ(a.spans.size(), b.spans.size());
  for (std::size_t i = 0; i < a.spans.size(); ++i) {
    ASSERT_EQ(a.spans[i].line, b.spans[i].line);
    ASSERT_EQ(a.spans[i].column, b.spans[i].column);
    ASSERT_EQ(a.spans[i].count, b.spans[i].count);
    ASSERT_EQ(a.spans[i].i[span_unit::kDepthSet], b.spans[i].i[span_unit::kDepthSet]);
    ASSERT_EQ(a.spans[i].di[span_unit::kDepthSet], b.spans[i].di[span_unit::kDepthSet]);
  }
}

TEST(PixelShading, EveryTriangleOfAPixelMethodIsShadedAndNoCornerIsLit) {
  World world;
  fill(world);
  const Host gouraud(world, ShadingMethod::gouraud);
  // Near viewer and far light, Blinn: of Phong's model there is a vector less, and L.V.
  const std::pair<ShadingMethod, std::uint64_t> words[] = {{ShadingMethod::phong, 3 + 9 + 9 + 3},
                                                           {ShadingMethod::duff, 3 + 6 + 2 * 3},
                                                           {ShadingMethod::taylor, 3 + 2 * 6},
                                                           {ShadingMethod::angular, 3 + 33 + 2 * 3}};
  for (const auto& [method, set_up_words] : words) {
    const Host host(world, method);
    ASSERT_EQ(host.drawn.size(), gouraud.drawn.size());
    EXPECT_GT(host.drawn.size(), 20U);
    for (std::size_t i = 0; i < host.drawn.size(); ++i) {
      ASSERT_NE(host.drawn[i].load.shading, nullptr);
      expect_same_pixels(host.drawn[i], gouraud.drawn[i]);
      const bool starts_again = host.drawn[i].load.count == 2 && !host.drawn[i].load.second_goes_on;
      ASSERT_EQ(host.drawn[i].words, gouraud.drawn[i].words - (starts_again ? 15 : 9) + set_up_words);
    }
    EXPECT_EQ(host.work.counts().lighting.evaluations, 0U);
    EXPECT_EQ(host.work.counts().words.total(), sum_of_words(host.drawn));
    EXPECT_EQ(host.work.counts().colour.drawn, host.drawn.size() + 1);
    EXPECT_EQ(host.work.counts().shaded, host.drawn.size());
    EXPECT_EQ(host.work.counts().colour.drawn, gouraud.work.counts().colour.drawn);
  }
}

TEST(PixelShading, GouraudPhongShadesTheTrianglesWithAHighlight) {
  World world;
  fill(world);
  const Host gouraud(world, ShadingMethod::gouraud), chosen(world, ShadingMethod::gouraud_phong),
      phong(world, ShadingMethod::phong);
  ASSERT_EQ(chosen.drawn.size(), gouraud.drawn.size());
  set_up::HighlightClassifier classifier(world.meshes[0], Host::surfaces());
  const geometry::Pose pose = world.pose(0);
  const std::vector<geometry::LightSource> lights{{false, pose.lights[0].vector, glm::dvec3(1.0), glm::dvec3(1.0)}};
  const auto& marks = classifier.classify(pose.object_to_eye[0], {lights, true}, 0);
  std::size_t shaded = 0;
  for (std::size_t i = 0; i < chosen.drawn.size(); ++i) {
    const Drawn& one = chosen.drawn[i];
    const bool marked = marks[one.load.object - 1] != set_up::Highlighted::no;
    ASSERT_EQ(one.load.shading != nullptr, marked);
    expect_same_pixels(one, gouraud.drawn[i]);
    if (marked) {
      ++shaded;
      ASSERT_EQ(one.levels, phong.drawn[i].levels);
      continue;
    }
    for (std::size_t k = 0; k < one.spans.size(); ++k)
      for (std::size_t c = 0; c < span_unit::kDepthSet; ++c)
        ASSERT_EQ(one.spans[k].i[c], gouraud.drawn[i].spans[k].i[c]);
    ASSERT_EQ(one.words, gouraud.drawn[i].words);
  }
  const std::size_t unseen = marks.back() != set_up::Highlighted::no ? 1 : 0;  // the last triangle, between lines
  EXPECT_GT(shaded, 0U);
  EXPECT_LT(shaded, chosen.drawn.size());
  EXPECT_EQ(chosen.work.counts().shaded, shaded);
  EXPECT_EQ(chosen.work.counts().lighting.evaluations, 3 * (chosen.work.counts().colour.drawn - shaded - unseen));
}

// The back of a triangle that has two sides is lit as the front of one that is turned round.
TEST(PixelShading, BacksAreLitWithTheirNormalsTurned) {
  World world, turned;
  fill(world, true);
  fill(turned, true);
  geometry::Mesh& mesh = turned.meshes[0];
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (glm::dvec3& normal : mesh.normals) normal = -normal;
  const Host a(world, ShadingMethod::phong), b(turned, ShadingMethod::phong);
  ASSERT_EQ(a.drawn.size(), b.drawn.size());
  for (std::size_t i = 0; i < a.drawn.size(); ++i) {
    ASSERT_EQ(a.drawn[i].levels.size(), b.drawn[i].levels.size());
    for (std::size_t n = 0; n < a.drawn[i].levels.size(); ++n)
      ASSERT_LT(glm::distance(a.drawn[i].levels[n], b.drawn[i].levels[n]), 1e-6);
  }
}

// What the host is charged for a shading is what setting it up takes, counted.
TEST(PixelShading, TheHostIsChargedForSetUp) {
  World world;
  fill(world);
  for (const ShadingMethod method : {ShadingMethod::phong, ShadingMethod::duff, ShadingMethod::taylor}) {
    Host host(world, method, {}, set_up::Attributes::linear);
    const auto& counters = host.work.shader()->counters();
    EXPECT_EQ(counters.triangles, host.drawn.size());
    EXPECT_EQ(counters.set_up, host.work.shader()->set_up_cost() * host.drawn.size());
    // All that another method's frame takes more is its set-ups'.
    const Host phong(world, ShadingMethod::phong, {}, set_up::Attributes::linear);
    const std::uint64_t more = host.work.counts().operations.flops() - phong.work.counts().operations.flops();
    EXPECT_EQ(more, host.work.counts().colour.drawn *
                        (host.work.shader()->set_up_cost().flops() - phong.work.shader()->set_up_cost().flops()));
  }
}

}  // namespace
}  // namespace rastertlm::host
