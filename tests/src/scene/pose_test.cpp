// Where things stand: against GLM's own matrices, which call the C library, to 1e-12, and against positions worked by
// hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "src/scene/animation.h"
#include "src/scene/transform.h"
#include "tests/src/scene/support.h"

namespace rastertlm::scene {
namespace {

using namespace testing;

template <class Matrix>
double difference(const Matrix& a, const Matrix& b) {
  double worst = 0.0;
  for (int column = 0; column < Matrix::length(); ++column)
    for (int row = 0; row < Matrix::length(); ++row)
      worst = std::max(worst, std::fabs(a[column][row] - b[column][row]));
  return worst;
}

glm::dvec3 at(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1.0)); }

TEST(Transform, AgreesWithGlm) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> u(-3.0, 3.0);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 a(u(random), u(random), u(random));
    const glm::dvec3 b(u(random), u(random), u(random));
    const glm::dvec3 c(u(random), u(random), u(random));
    const double angle = 100.0 * u(random);
    EXPECT_LT(difference(rotation_deg(a, angle), glm::rotate(glm::dmat4(1.0), glm::radians(angle), glm::normalize(a))),
              1e-12);
    if (glm::length(glm::cross(b - a, c)) > 0.1) {
      EXPECT_LT(difference(look_at(a, b, c), glm::lookAtRH(a, b, c)), 1e-12);
    }
    EXPECT_LT(difference(translation(a) * scaling(b), glm::scale(glm::translate(glm::dmat4(1.0), a), b)), 1e-12);
    const double fov = 30.0 + 9.0 * u(random);
    const double near = 1.5 + 0.4 * u(random);
    EXPECT_LT(
        difference(perspective(fov, 1.25, near, 50.0), glm::perspectiveRH_ZO(glm::radians(fov), 1.25, near, 50.0)),
        1e-12);
    EXPECT_LT(difference(orthographic(5.0, 4.0, a.x, 50.0), glm::orthoRH_ZO(-2.5, 2.5, -2.0, 2.0, a.x, 50.0)), 1e-12);
    const glm::dmat3 m(a, b, c);
    if (std::fabs(glm::determinant(m)) > 0.5) {
      EXPECT_LT(difference(inverse_transpose(m), glm::inverseTranspose(m)), 1e-12);
    }
  }
}

TEST(Transform, RotationsAreAboutXThenYThenZ) {
  EXPECT_EQ(at(rotation_xyz_deg({90, 90, 0}), {0, 1, 0}), glm::dvec3(1, 0, 0));  // y -> z -> x
  EXPECT_EQ(at(rotation_xyz_deg({0, 90, 90}), {0, 0, 1}), glm::dvec3(0, 1, 0));  // z -> x -> y
}

TEST(Pose, SeesTheTargetInTheMiddle) {
  const Scene scene = build_scene(sound_scene(), "", ".");
  const Pose p = pose(scene, 0, 640, 480);
  const glm::dvec4 middle = p.eye_to_clip * p.world_to_eye * glm::dvec4(0.0, 0.0, 1.5, 1.0);
  EXPECT_NEAR(middle.x / middle.w, 0.0, 1e-15);
  EXPECT_NEAR(middle.y / middle.w, 0.0, 1e-15);
  EXPECT_NEAR(middle.w, std::hypot(14.0, 3.5), 1e-12);
  // near is 0, far is 1, before the eye on its axis
  for (const auto& [distance, depth] : {std::pair{1.0, 0.0}, std::pair{100.0, 1.0}}) {
    const glm::dvec4 clip = p.eye_to_clip * glm::dvec4(0.0, 0.0, -distance, 1.0);
    EXPECT_NEAR(clip.z / clip.w, depth, 1e-12);
  }
  // the upper border of the picture is at half the field of view, the right one at 4/3 of its tangent
  const double t = std::tan(15.0 * 3.14159265358979323846 / 180.0);
  const glm::dvec4 corner = p.eye_to_clip * glm::dvec4(t * 640.0 / 480.0, t, -1.0, 1.0);
  EXPECT_NEAR(corner.x / corner.w, 1.0, 1e-12);
  EXPECT_NEAR(corner.y / corner.w, 1.0, 1e-12);
}

TEST(Pose, OrthographicPutsTheSphereOnItsPixel) {
  SceneDescription d = sound_scene();
  d.camera.projection = ProjectionKind::orthographic;
  d.camera.eye = {0, -1000, 0};
  d.camera.target = {0, 0, 0};
  d.camera.height = 512;
  d.camera.near = 700;
  d.camera.far = 1300;
  d.objects[0].kind = ObjectKind::uv_sphere;
  d.objects[0].radius = 240;
  d.objects[0].translate = {0.8, 0, -0.2};
  const Pose p = pose(build_scene(d, "", "."), 0, 512, 512);
  const glm::dvec4 ndc = p.eye_to_clip * p.object_to_eye[0] * glm::dvec4(0, 0, 0, 1);
  EXPECT_NEAR((ndc.x + 1) * 256 - 0.5, 256.3, 1e-12);
  EXPECT_NEAR((1 - ndc.y) * 256 - 0.5, 255.7, 1e-12);
  const glm::dvec4 north = p.eye_to_clip * p.object_to_eye[0] * glm::dvec4(0, 0, 240, 1);
  EXPECT_NEAR((1 - north.y) * 256 - 0.5, 255.7 - 240, 1e-12);
}

TEST(Pose, LightsAreInEyeSpace) {
  SceneDescription d = sound_scene();
  d.camera.eye = {0, -10, 0};
  d.camera.target = {0, 0, 0};
  d.lights[0].towards = {3, -4, 0};
  d.lights.emplace_back();
  d.lights[1].kind = LightKind::point;
  d.lights[1].position = {1, 2, 3};
  const Pose p = pose(build_scene(d, "", "."), 0, 1, 1);
  EXPECT_LT(glm::length(p.lights[0].vector - glm::dvec3(0.6, 0, 0.8)), 1e-15);  // eye x = world x, y = z, z = -y
  EXPECT_LT(glm::length(p.lights[1].vector - glm::dvec3(1, 3, -12)), 1e-14);
}

TEST(Pose, NormalsStayNormalToTheSurfaceAndAtMostUnit) {
  SceneDescription d = sound_scene();
  d.objects[0].scale = {1, 2, -0.25};
  d.objects[0].rotate_deg = {20, -40, 70};
  const Scene scene = build_scene(d, "", ".");
  const Pose p = pose(scene, 0, 1, 1);
  const Mesh& mesh = scene.objects[0].mesh;
  double longest = 0.0;
  for (const auto& n : mesh.normals) longest = std::max(longest, glm::length(p.normal_to_eye[0] * n));
  EXPECT_NEAR(longest, 1.0, 1e-12);
  // A tangent stays at right angles.
  const glm::dmat3 linear(p.object_to_eye[0]);
  for (const auto& n : mesh.normals) {
    const glm::dvec3 tangent = glm::cross(n, glm::dvec3(0.3, 0.5, 0.7));
    EXPECT_NEAR(glm::dot(linear * tangent, p.normal_to_eye[0] * n), 0.0, 1e-13);
  }
}

TEST(Pose, ARigidPlacementKeepsNormalsUnit) {
  SceneDescription d = sound_scene();
  d.objects[0].rotate_deg = {10, 20, 30};
  d.objects[0].scale = {3, 3, 3};
  const Scene scene = build_scene(d, "", ".");
  const Pose p = pose(scene, 0, 1, 1);
  for (const auto& n : scene.objects[0].mesh.normals) EXPECT_NEAR(glm::length(p.normal_to_eye[0] * n), 1.0, 1e-14);
}

AnimationDescription turning(AnimationKind kind, const Triple& centre, double degrees) {
  AnimationDescription a;
  a.kind = kind;
  a.centre = centre;
  a.deg_per_frame = degrees;
  return a;
}

TEST(Animation, SpinTurnsInTheObjectsOwnSpace) {
  const glm::dmat4 placement = translation({10, 0, 0}) * rotation_deg({1, 0, 0}, 90);
  const glm::dmat4 m = animate(placement, {turning(AnimationKind::spin, {1, 0, 0}, 90)}, 1);
  // own (2,0,0) -> about (1,0,0): (1,1,0) -> placement turns y to z: (11,0,1)
  EXPECT_EQ(at(m, {2, 0, 0}), glm::dvec3(11, 0, 1));
}

TEST(Animation, OrbitTurnsInWorldSpace) {
  const glm::dmat4 m = animate(translation({10, 0, 0}), {turning(AnimationKind::orbit, {5, 0, 0}, 90)}, 1);
  EXPECT_EQ(at(m, {0, 0, 0}), glm::dvec3(5, 5, 0));
}

TEST(Animation, SeveralApplyInOrder) {
  const auto orbit = turning(AnimationKind::orbit, {0, 0, 0}, 90);
  AnimationDescription keys;
  keys.kind = AnimationKind::keys;
  keys.keys = {{0, {1, 0, 0}, {0, 0, 0}}};
  EXPECT_EQ(at(animate(glm::dmat4(1.0), {keys, orbit}, 1), {0, 0, 0}), glm::dvec3(0, 1, 0));
  EXPECT_EQ(at(animate(glm::dmat4(1.0), {orbit, keys}, 1), {0, 0, 0}), glm::dvec3(1, 0, 0));
}

TEST(Animation, KeysGoLinearlyAndAreHeld) {
  const std::vector<KeyDescription> keys{
      {10, {0, 0, 0}, {0, 0, 0}}, {20, {4, 0, -2}, {0, 0, 90}}, {40, {4, 8, -2}, {0, 0, 0}}};
  EXPECT_EQ(interpolate(keys, 0).translate, (Triple{0, 0, 0}));
  EXPECT_EQ(interpolate(keys, 15).translate, (Triple{2, 0, -1}));
  EXPECT_EQ(interpolate(keys, 15).rotate_deg, (Triple{0, 0, 45}));
  EXPECT_EQ(interpolate(keys, 20).translate, (Triple{4, 0, -2}));
  EXPECT_EQ(interpolate(keys, 25).translate, (Triple{4, 2, -2}));
  EXPECT_EQ(interpolate(keys, 1e6).translate, (Triple{4, 8, -2}));
  AnimationDescription a;
  a.kind = AnimationKind::keys;
  a.keys = keys;
  // at frame 20, turned about where its origin is, then moved
  EXPECT_EQ(at(animate(translation({1, 1, 1}), {a}, 20), {1, 0, 0}), glm::dvec3(5, 2, -1));
}

TEST(Animation, AMillionFramesDoNotDrift) {
  const AnimationDescription a = turning(AnimationKind::spin, {0.3, -0.2, 0.0}, 0.36);  // 1000 frames a turn
  const glm::dmat4 placement = translation({1, 2, 3}) * rotation_deg({1, 1, 0}, 33);
  EXPECT_LT(difference(animate(placement, {a}, 1'000'000), placement), 1e-12);
  EXPECT_LT(difference(animate(placement, {a}, 1'000'123), animate(placement, {a}, 123)), 1e-12);
  const glm::dmat3 m(animate(placement, {a}, 987'654));
  EXPECT_LT(difference(glm::transpose(m) * m, glm::dmat3(1.0)), 1e-14);
}

TEST(Animation, CameraOrbitLooksAtItsTarget) {
  const View still{{0, -10, 2}, {0, 0, 1}, {0, 0, 1}};
  const View v = animate(still, {turning(AnimationKind::orbit, {0, 0, 0}, 90)}, 1);
  EXPECT_EQ(v.eye, glm::dvec3(10, 0, 2));
  EXPECT_EQ(v.target, still.target);
  EXPECT_EQ(v.up, still.up);
}

TEST(Animation, CameraSpinLooksRoundFromWhereItIs) {
  const View v = animate(View{{0, -10, 2}, {0, 0, 2}, {0, 0, 1}}, {turning(AnimationKind::spin, {0, 0, 0}, 90)}, 1);
  EXPECT_EQ(v.eye, glm::dvec3(0, -10, 2));
  EXPECT_EQ(v.target, glm::dvec3(-10, -10, 2));
}

TEST(Animation, CameraKeysMoveEyeAndTarget) {
  AnimationDescription a;
  a.kind = AnimationKind::keys;
  a.keys = {{0, {1, 2, 3}, {0, 0, 90}}};
  const View v = animate(View{{0, -10, 0}, {0, 0, 0}, {0, 0, 1}}, {a}, 0);
  EXPECT_EQ(v.eye, glm::dvec3(1, -8, 3));
  EXPECT_EQ(v.target, glm::dvec3(-9, -8, 3));
}

TEST(Animation, ACameraThatCannotLookIsRefusedWithItsFrame) {
  SceneDescription d = sound_scene();
  d.camera.eye = {0, -10, 0};
  d.camera.target = {10, 0, 0};
  d.camera.animation = {turning(AnimationKind::orbit, {0, 0, 0}, 45)};
  const Scene scene = build_scene(d, "", ".");
  EXPECT_NO_THROW(pose(scene, 1, 1, 1));
  try {
    pose(scene, 2, 1, 1);
    FAIL() << "the eye is at its target";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "camera.animation: at frame 2: eye and target are the same point");
  }
}

TEST(Animation, MovesWhereAnyFrameDiffers) {
  SceneDescription d = sound_scene();
  d.objects.push_back(d.objects[0]);
  d.objects[1].animation = {turning(AnimationKind::spin, {0, 0, 0}, 3)};
  Scene scene = build_scene(d, "", ".");
  EXPECT_FALSE(camera_moves(scene));
  EXPECT_FALSE(object_moves(scene, 0));
  EXPECT_TRUE(object_moves(scene, 1));
  EXPECT_EQ(pose(scene, 0, 1, 1).object_to_eye[0], pose(scene, 7, 1, 1).object_to_eye[0]);
  EXPECT_NE(pose(scene, 0, 1, 1).object_to_eye[1], pose(scene, 7, 1, 1).object_to_eye[1]);

  EXPECT_FALSE(moves({turning(AnimationKind::orbit, {0, 0, 0}, 0)}));
  EXPECT_FALSE(moves({turning(AnimationKind::orbit, {0, 0, 0}, 720)}));
  AnimationDescription keys;
  keys.kind = AnimationKind::keys;
  keys.keys = {{0, {1, 0, 0}, {0, 0, 0}}, {5, {1, 0, 0}, {0, 0, 0}}};
  EXPECT_FALSE(moves({keys}));
  keys.keys[1].rotate_deg[2] = 10;
  EXPECT_TRUE(moves({keys}));
}

}  // namespace
}  // namespace rastertlm::scene
