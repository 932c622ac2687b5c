// Scenes made of descriptions, and everything that is refused.
#include "src/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "tests/src/scene/mesh_checks.h"
#include "tests/src/scene/support.h"

namespace rastertlm::scene {
namespace {

using namespace testing;
using ::testing::HasSubstr;

TEST(BuildScene, MakesTheTeapot) {
  const Scene scene = build_scene(sound_scene(), "scene.toml", ".");
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_EQ(scene.triangle_count(), 896U);
  EXPECT_EQ(scene.objects[0].mesh.degenerate, 16U);
  EXPECT_EQ(scene.objects[0].mesh.material, std::vector<std::uint16_t>(896, 0));
  EXPECT_NEAR(glm::length(scene.lights[0].vector), 1.0, 1e-15);
  EXPECT_EQ(scene.digest.size(), 64U);
}

TEST(BuildScene, PlacesByScaleThenRotationThenTranslation) {
  SceneDescription d = one_triangle();
  d.objects[0].scale = {2, 3, 4};
  d.objects[0].rotate_deg = {90, 0, 90};
  d.objects[0].translate = {10, 20, 30};
  const glm::dmat4 m = build_scene(d, "", ".").objects[0].placement;
  // x -> (2,0,0) -> about x: same -> about z: (0,2,0); y -> (0,3,0) -> (0,0,3); z -> (0,0,4) -> (0,-4,0) -> (4,0,0).
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(1, 0, 0, 1)), glm::dvec3(10, 22, 30));
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(0, 1, 0, 1)), glm::dvec3(10, 20, 33));
  EXPECT_EQ(glm::dvec3(m * glm::dvec4(0, 0, 1, 1)), glm::dvec3(14, 20, 30));
}

TEST(BuildScene, AMirroredObjectKeepsItsOutside) {
  SceneDescription d = sound_scene();
  d.objects[0].kind = ObjectKind::uv_sphere;
  d.objects[0].scale = {1, -2, 1};
  Mesh placed = build_scene(d, "", ".").objects[0].mesh;
  for (auto& p : placed.positions) p.y *= -2;
  for (auto& n : placed.normals) n = glm::normalize(glm::dvec3(n.x, n.y / -2, n.z));
  EXPECT_GT(signed_volume(placed), 0.0);
  EXPECT_GT(worst_agreement(placed), 0.5);
}

TEST(BuildScene, InlineTrianglesWithoutNormalsAreSmooth) {
  SceneDescription d = one_triangle();
  // Two faces of a roof that share the ridge (0,0,1)-(0,1,1), each with its own corners.
  d.objects[0].positions = {{-1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 0}, {0, 1, 1}, {0, 0, 1}};
  const Mesh mesh = build_scene(d, "", ".").objects[0].mesh;
  EXPECT_EQ(mesh.positions.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    if (mesh.positions[i] == glm::dvec3(0, 1, 1) || mesh.positions[i] == glm::dvec3(0, 0, 1)) {
      EXPECT_NEAR(std::fabs(mesh.normals[i].z), 1.0, 0.2) << i;
    }
}

TEST(BuildScene, InlineNormalsAreBroughtToLengthOne) {
  SceneDescription d = one_triangle();
  d.objects[0].normals = {{0, -3, 0}, {0, -1, 0}, {3, 0, 4}};
  const Mesh mesh = build_scene(d, "", ".").objects[0].mesh;
  EXPECT_EQ(mesh.normals[0], glm::dvec3(0, -1, 0));
  EXPECT_LT(glm::length(mesh.normals[2] - glm::dvec3(0.6, 0, 0.8)), 1e-15);
}

TEST(BuildScene, IndexedAndPlainTrianglesAreTheSame) {
  SceneDescription plain = one_triangle();
  plain.objects[0].positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  SceneDescription indexed = one_triangle();
  indexed.objects[0].positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  indexed.objects[0].indices = {{0, 1, 2}, {0, 2, 3}};
  const Mesh a = build_scene(plain, "", ".").objects[0].mesh;
  const Mesh b = build_scene(indexed, "", ".").objects[0].mesh;
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(BuildScene, WithoutAMaterialTheFirstIsTaken) {
  SceneDescription d = sound_scene();
  d.objects[0].material = "";
  EXPECT_EQ(build_scene(d, "", ".").objects[0].mesh.material[0], 0);
}

TEST(BuildScene, DigestTellsDescriptionsApart) {
  const std::string digest = build_scene(sound_scene(), "a", ".").digest;
  EXPECT_EQ(digest, build_scene(sound_scene(), "b", "/").digest);
  SceneDescription other = sound_scene();
  other.materials[0].ambient = 0.2;
  EXPECT_NE(digest, build_scene(other, "a", ".").digest);
  other = sound_scene();
  other.objects[0].animation.emplace_back();
  EXPECT_NE(digest, build_scene(other, "a", ".").digest);
}

struct Case {
  std::string name;
  std::function<void(SceneDescription&)> spoil;
  std::string text;
};

std::ostream& operator<<(std::ostream& stream, const Case& c) { return stream << c.name; }

class Refused : public ::testing::TestWithParam<Case> {};

TEST_P(Refused, NamesFileAndKey) {
  SceneDescription d = sound_scene();
  GetParam().spoil(d);
  EXPECT_EQ(refusal(d), "scene.toml: " + GetParam().text);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void make_triangle(SceneDescription& d) { d.objects[0] = one_triangle().objects[0]; }
AnimationDescription& animate(SceneDescription& d) { return d.objects[0].animation.emplace_back(); }

INSTANTIATE_TEST_SUITE_P(
    Settings, Refused,
    ::testing::Values(
        Case{"NoObject", [](SceneDescription& d) { d.objects.clear(); }, "object: the scene has no object"},
        Case{"NoLight", [](SceneDescription& d) { d.lights.clear(); }, "light: the scene has no light"},
        Case{"NoMaterial",
             [](SceneDescription& d) {
               d.materials.clear();
               d.objects[0].material = "";
             },
             "object[0].material: the scene has no material"},
        Case{"UnknownMaterial", [](SceneDescription& d) { d.objects[0].material = "glase"; },
             "object[0].material: there is no material 'glase'; nearest: 'glaze'"},
        Case{"MaterialTwice", [](SceneDescription& d) { d.materials.push_back(d.materials[0]); },
             "material[1].name: 'glaze' is the name of material[0] already"},
        Case{"MaterialWithoutName", [](SceneDescription& d) { d.materials.emplace_back(); },
             "material[1].name: a material needs a name"},
        Case{"EyeIsTarget", [](SceneDescription& d) { d.camera.target = d.camera.eye; },
             "camera.target: eye and target are the same point"},
        Case{"UpAlongView",
             [](SceneDescription& d) {
               d.camera.up = {0, 28, -7};
             },
             "camera.up: up is parallel to the direction of view"},
        Case{"NoUp",
             [](SceneDescription& d) {
               d.camera.up = {0, 0, 0};
             },
             "camera.up: up is zero"},
        Case{"NearIsFar", [](SceneDescription& d) { d.camera.far = 1; }, "camera.far: 1 must be beyond camera.near, 1"},
        Case{"NearZero", [](SceneDescription& d) { d.camera.near = 0; },
             "camera.near: 0 must be above 0 in perspective"},
        Case{"ZeroScale", [](SceneDescription& d) { d.objects[0].scale[1] = 0; },
             "object[0].scale[1]: 0 makes the object flat"},
        Case{"ZeroTowards",
             [](SceneDescription& d) {
               d.lights[0].towards = {0, 0, 0};
             },
             "light[0].towards: has no length"},
        Case{"NanEye", [](SceneDescription& d) { d.camera.eye[1] = kNan; }, "camera.eye[1]: is not a finite number"},
        Case{"ThirtyPatches", [](SceneDescription& d) { d.objects[0].patches = 30; },
             "object[0].patches: 30 is not accepted; accepted values: 28, 32"},
        Case{"NoSegment", [](SceneDescription& d) { d.objects[0].segments = 0; },
             "object[0].segments: 0 is out of range: from 1 to 128"},
        Case{"NegativeRadius",
             [](SceneDescription& d) {
               d.objects[0].kind = ObjectKind::uv_sphere;
               d.objects[0].radius = -1;
             },
             "object[0].radius: -1 is out of range: above 0 to 1000000000"},
        Case{"NoFileName", [](SceneDescription& d) { d.objects[0].kind = ObjectKind::mesh; },
             "object[0].file: a mesh needs a file"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Animations, Refused,
    ::testing::Values(Case{"ZeroAxis",
                           [](SceneDescription& d) {
                             animate(d).axis = {0, 0, 0};
                           },
                           "object[0].animation[0].axis: has no length"},
                      Case{"NoKeys", [](SceneDescription& d) { animate(d).kind = AnimationKind::keys; },
                           "object[0].animation[0].key: an animation of type keys needs at least one"},
                      Case{"KeysBackwards",
                           [](SceneDescription& d) {
                             AnimationDescription& a = animate(d);
                             a.kind = AnimationKind::keys;
                             a.keys = {{5, {}, {}}, {5, {}, {}}};
                           },
                           "object[0].animation[0].key[1].frame: 5 is not after the key before it, at 5"},
                      Case{"KeysOfASpin", [](SceneDescription& d) { animate(d).keys.emplace_back(); },
                           "object[0].animation[0].key: belongs to animations of type keys only"},
                      Case{"CameraAxis",
                           [](SceneDescription& d) {
                             d.camera.animation.emplace_back();
                             d.camera.animation[0].axis = {0, 0, 0};
                           },
                           "camera.animation[0].axis: has no length"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Triangles, Refused,
    ::testing::Values(Case{"NoPosition",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].positions.clear();
                           },
                           "object[0].positions: has no position"},
                      Case{"FourPositions",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].positions.push_back({1, 1, 1});
                           },
                           "object[0].positions: 4 positions without indices are not three a triangle"},
                      Case{"IndexTooLarge",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].indices = {{0, 1, 2}, {0, 1, 3}};
                           },
                           "object[0].indices[1]: position 3 does not exist: there are 3, counted from 0"},
                      Case{"IndexNegative",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].indices = {{0, -1, 2}};
                           },
                           "object[0].indices[0]: position -1 does not exist: there are 3, counted from 0"},
                      Case{"TwoNormals",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].normals = {{0, 0, 1}, {0, 0, 1}};
                           },
                           "object[0].normals: 2 normals for 3 positions: give one a position, or none"},
                      Case{"ZeroNormal",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].normals = {{0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
                           },
                           "object[0].normals[1]: has no length"},
                      Case{"InfinitePosition",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].positions[2][0] = kInfinity;
                           },
                           "object[0].positions[2][0]: is not a finite number"},
                      Case{"NoArea",
                           [](SceneDescription& d) {
                             make_triangle(d);
                             d.objects[0].positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
                           },
                           "object[0]: none of its 1 triangles has an area"}),
    [](const auto& tested) { return tested.param.name; });

TEST(BuildScene, SaysEverythingAtOnce) {
  SceneDescription d = sound_scene();
  d.camera.far = 0.5;
  d.lights.clear();
  d.objects[0].material = "glase";
  d.objects.push_back(one_triangle().objects[0]);
  d.objects[1].positions.pop_back();
  d.objects.emplace_back();
  d.objects[2].kind = ObjectKind::mesh;
  d.objects[2].file = "none.obj";
  const std::string text = refusal(d);
  EXPECT_THAT(text, HasSubstr("camera.far"));
  EXPECT_THAT(text, HasSubstr("light: the scene has no light"));
  EXPECT_THAT(text, HasSubstr("object[0].material"));
  EXPECT_THAT(text, HasSubstr("object[1].positions"));
  EXPECT_THAT(text, HasSubstr("object[2].file: 'none.obj' does not exist"));
}

TEST(BuildScene, AnOrthographicCameraMaySeeBehindItself) {
  SceneDescription d = sound_scene();
  d.camera.projection = ProjectionKind::orthographic;
  d.camera.near = -10;
  EXPECT_EQ(refusal(d), "");
}

}  // namespace
}  // namespace rastertlm::scene
