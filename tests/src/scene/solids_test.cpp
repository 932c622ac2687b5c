// Solids of scene files: what is inside, by words of geometry that know no matrix, and everything that is refused.
#include "src/scene/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <ostream>
#include <random>

#include "tests/src/scene/support.h"

namespace rastertlm::scene {
namespace {

using namespace testing;

SceneDescription of_kind(ObjectKind kind) {
  SceneDescription d = sound_scene();
  d.objects[0].kind = kind;
  return d;
}

Solid solid_of(const ObjectDescription& object) {
  SceneDescription d = sound_scene();
  d.objects[0] = object;
  const Scene scene = build_scene(d, "scene.toml", ".");
  EXPECT_TRUE(scene.objects.at(0).mesh.triangles.empty());
  return scene.objects.at(0).solid.value();
}

// How far inside, in the units of the solid's matrix: the least of what the polynomial and the planes leave.
double depth_in(const Solid& solid, const glm::dvec3& at) {
  const glm::dvec4 x(at, 1.0);
  double depth = -glm::dot(x, solid.quadric * x);
  for (const glm::dvec4& plane : solid.planes) depth = std::min(depth, -glm::dot(plane, x));
  return depth;
}

using Inside = std::function<bool(const glm::dvec3&)>;

// Over a box of points; those within rounding of the surface are left out.
void expect_inside(const ObjectDescription& object, const Inside& inside) {
  const Solid solid = solid_of(object);
  std::mt19937 engine(7);
  const auto number = [&] { return 8.0 * (static_cast<double>(engine()) / 4294967296.0 - 0.5); };
  int in = 0, out = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 at(number(), number(), number());
    const double depth = depth_in(solid, at);
    if (std::fabs(depth) < 1e-9) continue;
    ++(depth > 0.0 ? in : out);
    if ((depth > 0.0) != inside(at)) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(in, 50);
  EXPECT_GT(out, 50);
  double largest = 0.0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      EXPECT_EQ(solid.quadric[column][row], solid.quadric[row][column]);
      largest = std::max(largest, std::fabs(solid.quadric[column][row]));
    }
  EXPECT_GE(largest, 1.0);
  EXPECT_LT(largest, 2.0);
  for (const glm::dvec4& plane : solid.planes) EXPECT_NEAR(glm::length(glm::dvec3(plane)), 1.0, 1e-15);
}

double from_axis(const glm::dvec3& at) { return std::hypot(at.x, at.y); }

ObjectDescription lengths(ObjectKind kind, double radius, double height) {
  ObjectDescription object;
  object.kind = kind;
  object.radius = radius;
  object.height = height;
  return object;
}

TEST(Solids, Spheres) {
  expect_inside(lengths(ObjectKind::sphere, 2.5, 1), [](const glm::dvec3& at) { return glm::length(at) < 2.5; });
  ObjectDescription object = lengths(ObjectKind::ellipsoid, 1, 1);
  object.radii = {1.5, 3.0, 0.75};
  expect_inside(object, [](const glm::dvec3& at) { return glm::length(at / glm::dvec3(1.5, 3.0, 0.75)) < 1.0; });
}

TEST(Solids, OfAHeight) {
  const auto between = [](const glm::dvec3& at, double height) { return at.z > 0.0 && at.z < height; };
  for (const bool capped : {true, false}) {
    ObjectDescription object = lengths(ObjectKind::cylinder, 2.0, 3.0);
    object.capped = capped;
    expect_inside(object, [&](const glm::dvec3& at) { return from_axis(at) < 2.0 && (!capped || between(at, 3.0)); });
    object.kind = ObjectKind::cone;
    expect_inside(object, [&](const glm::dvec3& at) {
      return from_axis(at) < 2.0 * std::fabs(1.0 - at.z / 3.0) && (!capped || between(at, 3.0));
    });
    object.kind = ObjectKind::paraboloid;
    expect_inside(object, [&](const glm::dvec3& at) {
      return at.z < 3.0 && from_axis(at) < 2.0 * std::sqrt(1.0 - at.z / 3.0) && (!capped || between(at, 3.0));
    });
  }
}

// At the waist and at half the height the radii are those of the file.
TEST(Solids, Hyperboloids) {
  ObjectDescription object = lengths(ObjectKind::hyperboloid, 2.0, 6.0);
  object.waist = 0.8;
  expect_inside(object, [](const glm::dvec3& at) {
    const double t = at.z / 3.0;
    return std::fabs(t) < 1.0 && from_axis(at) < std::sqrt(0.64 + (4.0 - 0.64) * t * t);
  });
  object.sheets = 2;
  object.capped = false;
  expect_inside(object, [](const glm::dvec3& at) {
    const double beyond = at.z * at.z - 0.64;
    return beyond > 0.0 && from_axis(at) < 2.0 * std::sqrt(beyond / (9.0 - 0.64));
  });
}

TEST(Solids, PolynomialsAndPlanes) {
  ObjectDescription object = lengths(ObjectKind::quadric, 1, 1);
  object.squares = {1, 2, -3};
  object.products = {0.5, -0.7, 0.9};
  object.linear = {1.1, -0.2, 0.4};
  object.constant = -2.5;
  const auto value = [](const glm::dvec3& p) {
    return p.x * p.x + 2 * p.y * p.y - 3 * p.z * p.z + 0.5 * p.x * p.y - 0.7 * p.y * p.z + 0.9 * p.z * p.x + 1.1 * p.x -
           0.2 * p.y + 0.4 * p.z - 2.5;
  };
  expect_inside(object, [&](const glm::dvec3& at) { return value(at) < 0.0; });
  object.planes.push_back({{3, 0, -4}, 2.0});
  object.planes.push_back({{0, 1, 0}, 1.0});
  expect_inside(object,
                [&](const glm::dvec3& at) { return value(at) < 0.0 && 3 * at.x - 4 * at.z < 2.0 && at.y < 1.0; });
}

// Numbers of any size: the matrix is brought to about 1, and planes that leave nothing are no mistake.
TEST(Solids, OfAnySizeAndOfNothing) {
  SceneDescription d = of_kind(ObjectKind::sphere);
  for (const double radius : {1e-6, 1e9}) {
    d.objects[0].radius = radius;
    EXPECT_EQ(refusal(d), "") << radius;
    const Solid solid = solid_of(d.objects[0]);
    EXPECT_GT(depth_in(solid, {0, 0, 0.999 * radius}), 0.0);
    EXPECT_LT(depth_in(solid, {0, 0, 1.001 * radius}), 0.0);
  }
  d.objects[0].planes = {{{0, 0, 1}, -1e9}, {{0, 0, -1}, -1e9}};
  EXPECT_EQ(refusal(d), "");
  d = of_kind(ObjectKind::quadric);
  d.objects[0].squares = {1e-40, 1e-40, 1e-40};
  d.objects[0].constant = -1e-40;
  EXPECT_EQ(refusal(d), "");
}

// A wall between two planes, a point that is far away: it is the polynomial that decides, not its matrix.
TEST(Solids, AreTakenWhereTheyHaveAVolume) {
  SceneDescription d = of_kind(ObjectKind::quadric);
  ObjectDescription& q = d.objects[0];
  q.squares = {1, 0, 0};
  EXPECT_EQ(refusal(d), "");  // a wall
  q = of_kind(ObjectKind::quadric).objects[0];
  q.linear = {-2e6, 0, 0};
  q.constant = 1e12 - 1;
  EXPECT_EQ(refusal(d), "");  // a sphere at x = 1e6
  q.constant = 1e12;
  EXPECT_NE(refusal(d), "");  // its centre alone
  q.squares = {0, 0, 0};
  q.products = {1, 0, 0};
  q.linear = {0, 0, 0};
  q.constant = 5;
  EXPECT_EQ(refusal(d), "");  // x y <= -5
  q.products = {0, 0, 0};
  q.squares = {0, 1, 0};
  q.linear = {1, 0, 0};
  EXPECT_EQ(refusal(d), "");  // y^2 + x + 5 <= 0
}

TEST(Solids, NumbersAndSpheres) {
  SceneDescription d = of_kind(ObjectKind::sphere);
  d.objects[0].radius = 1.5;
  d.objects[0].scale = {2, -2, 2};
  d.objects.push_back(one_triangle().objects[0]);
  d.objects.push_back(of_kind(ObjectKind::cone).objects[0]);
  d.objects.push_back(d.objects[0]);
  d.objects[3].planes.emplace_back();
  d.objects.push_back(d.objects[0]);
  d.objects[4].scale = {1, 2, 1};
  const Scene scene = build_scene(d, "scene.toml", ".");
  EXPECT_EQ(scene.triangle_count(), 1U);
  EXPECT_EQ(scene.solid_count(), 4U);
  EXPECT_EQ(scene.object_count(), 5U);
  EXPECT_EQ(scene.objects[0].sphere_radius, 3.0);
  EXPECT_EQ(scene.objects[3].sphere_radius, 0.0) << "cut";
  EXPECT_EQ(scene.objects[4].sphere_radius, 0.0) << "not round";
  const std::vector<Diagnostic> refused = refuse_solids(scene, "why");
  ASSERT_EQ(refused.size(), 4U);
  EXPECT_EQ(refused[1].key, "object[2].type");
}

TEST(Solids, ThePlanesOfADescriptionAreOfItsDigest) {
  SceneDescription d = of_kind(ObjectKind::sphere);
  const std::string digest = build_scene(d, "a", ".").digest;
  d.objects[0].planes.emplace_back();
  const std::string cut = build_scene(d, "a", ".").digest;
  EXPECT_NE(cut, digest);
  d.objects[0].planes[0].distance = 0.5;
  EXPECT_NE(build_scene(d, "a", ".").digest, cut);
}

struct Case {
  std::string name;
  ObjectKind kind;
  std::function<void(ObjectDescription&)> spoil;
  std::string text;
};

std::ostream& operator<<(std::ostream& stream, const Case& c) { return stream << c.name; }

class RefusedSolids : public ::testing::TestWithParam<Case> {};

TEST_P(RefusedSolids, NamesFileAndKey) {
  SceneDescription d = of_kind(GetParam().kind);
  GetParam().spoil(d.objects[0]);
  EXPECT_EQ(refusal(d), "scene.toml: object[0]." + GetParam().text);
}

constexpr const char* kNothing = "nothing is inside: the polynomial must be below 0 somewhere";

INSTANTIATE_TEST_SUITE_P(
    Solids, RefusedSolids,
    ::testing::Values(
        Case{"NoRadius", ObjectKind::sphere, [](ObjectDescription& o) { o.radius = 0; },
             "radius: 0 is out of range: above 0 to 1000000000"},
        Case{"FlatEllipsoid", ObjectKind::ellipsoid, [](ObjectDescription& o) { o.radii[1] = 0; },
             "radii[1]: 0 is out of range: above 0 to 1000000000"},
        Case{"NoHeight", ObjectKind::cone, [](ObjectDescription& o) { o.height = -1; },
             "height: -1 is out of range: above 0 to 1000000000"},
        Case{"ThreeSheets", ObjectKind::hyperboloid, [](ObjectDescription& o) { o.sheets = 3; },
             "sheets: 3 is out of range: from 1 to 2"},
        Case{"WideWaist", ObjectKind::hyperboloid, [](ObjectDescription& o) { o.waist = 1; },
             "waist: 1 must be below radius, 1, where there is one sheet"},
        Case{"ApexesBeyondTheHeight", ObjectKind::hyperboloid,
             [](ObjectDescription& o) {
               o.sheets = 2;
               o.waist = 1;
             },
             "waist: 1 must be below 1, half of the height, where there are two sheets"},
        Case{"NotANumber", ObjectKind::quadric,
             [](ObjectDescription& o) { o.products[2] = std::numeric_limits<double>::quiet_NaN(); },
             "products[2]: is not a finite number"},
        Case{"InfiniteConstant", ObjectKind::quadric,
             [](ObjectDescription& o) { o.constant = -std::numeric_limits<double>::infinity(); },
             "constant: is not a finite number"},
        Case{"Plane", ObjectKind::quadric,
             [](ObjectDescription& o) {
               o.squares = {0, 0, 0};
               o.linear = {0, 0, 1};
             },
             "squares: a plane, not a quadric: squares and products are all 0, and one of them must not be"},
        Case{"NoPoint", ObjectKind::quadric, [](ObjectDescription& o) { o.constant = 1; },
             std::string("constant: ") + kNothing},
        Case{"OnePoint", ObjectKind::quadric, [](ObjectDescription& o) { o.constant = 0; },
             std::string("constant: ") + kNothing},
        Case{"NoPointInAnyDirection", ObjectKind::quadric,
             [](ObjectDescription& o) {  // (x + y - z)^2 + (x - 0.1)^2 + 1e-9
               o.squares = {2, 1, 1};
               o.products = {2, -2, -2};
               o.linear = {-0.2, 0, 0};
               o.constant = 0.01 + 1e-9;
             },
             std::string("constant: ") + kNothing},
        Case{"LengthsTooFarApart", ObjectKind::ellipsoid, [](ObjectDescription& o) { o.radii[0] = 1e-200; },
             "type: its lengths are too large or too small beside each other"},
        Case{"PlaneWithoutNormal", ObjectKind::sphere,
             [](ObjectDescription& o) {
               o.planes.resize(2);
               o.planes[1].normal = {0, 0, 0};
             },
             "plane[1].normal: has no length; one of its numbers must not be 0"},
        Case{"PlaneOfAMesh", ObjectKind::teapot, [](ObjectDescription& o) { o.planes.emplace_back(); },
             "plane: belongs to solids only: sphere to quadric"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace rastertlm::scene
