// Are solids where a walk along the ray meets them, with the normals of their geometry? The walk knows no quadric: it
// asks of points in the solid's own space whether they are inside.
#include "src/reference/solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "src/geometry/lighting.h"
#include "src/reference/sphere_renderer.h"
#include "tests/src/reference/solids.h"

namespace rastertlm::reference {
namespace {

using namespace testing_support;
using scene::ObjectKind;

constexpr std::size_t kColumns = 24, kLines = 18;

// A ray of a pixel from the near to the far plane, in eye space, and the solid that it may meet.
struct Walk {
  glm::dvec3 from, to;
  glm::dmat4 eye_to_object;
  glm::dmat4 eye_to_clip;
  const Constraints& constraints;

  glm::dvec3 at(double t) const { return from + t * (to - from); }
  double outside(const glm::dvec3& eye) const {  // the largest of what should be 0 and less
    const std::vector<double> values = constraints(glm::dvec3(eye_to_object * glm::dvec4(eye, 1.0)));
    return *std::max_element(values.begin(), values.end());
  }
  double depth(const glm::dvec3& eye) const {
    const glm::dvec4 clip = eye_to_clip * glm::dvec4(eye, 1.0);
    return clip.z / clip.w;
  }
  // The t of a depth, for a point of the ray.
  double along(double depth) const {
    const glm::dvec4 a = eye_to_clip * glm::dvec4(from, 1.0), b = eye_to_clip * glm::dvec4(to, 1.0);
    return (depth * a.w - a.z) / ((b.z - a.z) - depth * (b.w - a.w));
  }
};

glm::dvec3 eye_point(const glm::dmat4& eye_to_clip, std::size_t x, std::size_t y, double depth) {
  const glm::dvec4 p =
      glm::inverse(eye_to_clip) * glm::dvec4((static_cast<double>(x) + 0.5) * 2 / kColumns - 1,
                                             1 - (static_cast<double>(y) + 0.5) * 2 / kLines, depth, 1.0);
  return glm::dvec3(p) / p.w;
}

// The direction in which the constraint grows that holds the point, by differences in eye space; the near plane faces
// the eye.
glm::dvec3 normal_at(const Walk& walk, double t) {
  if (t < 1e-9) return {0, 0, 1};
  const glm::dvec3 at = walk.at(t);
  const auto values = [&](const glm::dvec3& eye) {
    return walk.constraints(glm::dvec3(walk.eye_to_object * glm::dvec4(eye, 1.0)));
  };
  const std::vector<double> here = values(at);
  const auto held = std::max_element(here.begin(), here.end()) - here.begin();
  constexpr double kStep = 1e-5;
  glm::dvec3 gradient;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 step(0.0);
    step[i] = kStep;
    gradient[i] = values(at + step)[static_cast<std::size_t>(held)] - values(at - step)[static_cast<std::size_t>(held)];
  }
  return glm::normalize(gradient);
}

// The levels of a point of that normal, for a viewer who is infinitely far or at the eye.
glm::dvec3 levels_at(const scene::Scene& scene, const scene::Pose& pose, const glm::dvec3& normal,
                     const glm::dvec3& viewer) {
  const scene::Material& m = scene.materials[0];
  const geometry::Reflectance surface{m.ambient * m.colour, m.diffuse * m.colour, glm::dvec3(m.specular), m.exponent};
  std::vector<geometry::LightSource> lights;
  for (const scene::Light& light : pose.lights)
    lights.push_back({false, light.vector, light.intensity, light.intensity});
  const glm::dvec3 light = geometry::illumination<double>(
      surface, lights, {geometry::Model::blinn, false, glm::dvec3(1)}, normal, viewer, glm::dvec3(0));
  return glm::clamp(255.0 * light, 0.0, 255.0);
}

struct Tally {
  int hits = 0, misses = 0, wrong = 0, walked = 0, at_near_plane = 0, lit = 0;
  double depth_off = 0.0, level_off = 0.0;
};

// One pixel of a picture with one solid.
void judge(const Walk& walk, const scene::Scene& scene, const scene::Pose& pose, const frame::ExactFrame& out,
           std::size_t pixel, bool viewer_at_eye, Tally& tally) {
  constexpr int kSteps = 600;
  const bool hit = out.object[pixel] != 0;
  ++(hit ? tally.hits : tally.misses);
  const double end = hit ? walk.along(out.depth[pixel]) : 1.0;
  int first = -1;
  for (int i = 0; i <= kSteps && first < 0; ++i)
    if (walk.outside(walk.at(static_cast<double>(i) / kSteps)) < -1e-9) first = i;
  if (first >= 0 && (!hit || static_cast<double>(first) / kSteps < end - 1e-9)) ++tally.wrong;
  if (!hit) return;
  if (walk.outside(walk.at(end)) > 1e-8) ++tally.wrong;
  if (first == 0) {
    ++tally.at_near_plane;
    tally.depth_off = std::max(tally.depth_off, out.depth[pixel]);
  }
  if (first > 0 && end > static_cast<double>(first - 1) / kSteps) {  // the step that it is in: halved
    double low = static_cast<double>(first - 1) / kSteps, high = static_cast<double>(first) / kSteps;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (walk.outside(walk.at(middle)) > 0.0 ? low : high) = middle;
    }
    ++tally.walked;
    tally.depth_off = std::max(tally.depth_off, std::fabs(walk.depth(walk.at(high)) - out.depth[pixel]));
  }
  const glm::dvec3 normal = first == 0 ? glm::dvec3(0, 0, 1) : normal_at(walk, end);
  // Grazing rays and tips: differences say little of the normal there.
  const glm::dvec3 ray = glm::normalize(walk.to - walk.from);
  if (!(std::fabs(glm::dot(normal, ray)) > 0.05)) return;
  ++tally.lit;
  const glm::dvec3 viewer = viewer_at_eye ? -glm::normalize(walk.at(end)) : glm::dvec3(0, 0, 1);
  const glm::dvec3 levels = levels_at(scene, pose, normal, viewer);
  for (int c = 0; c < 3; ++c)
    tally.level_off =
        std::max(tally.level_off, std::fabs(levels[c] - out.rgb[3 * pixel + static_cast<std::size_t>(c)]));
}

scene::CameraDescription camera_of(bool perspective, double distance) {
  scene::CameraDescription camera;
  camera.projection = perspective ? scene::ProjectionKind::perspective : scene::ProjectionKind::orthographic;
  camera.eye = {0, -distance, 0.3};
  camera.target = {0, 0, 0};
  camera.height = 5.0;
  camera.vertical_fov_deg = 40.0;
  camera.near = 1.0;
  camera.far = 20.0;
  return camera;
}

// `distance` small: the eye, or the near plane, is within the solids.
Tally walk_over(std::uint32_t seed, bool perspective, bool capped, Reference kind, double distance) {
  Random random(seed);
  Tally tally;
  for (KnownSolid& known : one_of_each(random, capped)) {
    scene::SceneDescription d = lit_scene(camera_of(perspective, distance));
    d.objects = {known.object};
    d.objects[0].rotate_deg = {random.between(-180, 180), random.between(-180, 180), random.between(-180, 180)};
    d.objects[0].translate = {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5)};
    d.objects[0].scale = {random.between(0.6, 1.4), -random.between(0.6, 1.4), random.between(0.6, 1.4)};
    const scene::Scene scene = scene::build_scene(d, "scene.toml", ".");
    const scene::Pose pose = scene::pose(scene, 0, kColumns, kLines);
    const frame::ExactFrame out = render(scene, pose, options_of(kind, kColumns, kLines));
    for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
      const std::size_t x = pixel % kColumns, y = pixel / kColumns;
      const Walk walk{eye_point(pose.eye_to_clip, x, y, 0.0), eye_point(pose.eye_to_clip, x, y, 1.0),
                      glm::inverse(pose.object_to_eye[0]), pose.eye_to_clip, known.constraints};
      judge(walk, scene, pose, out, pixel, perspective && kind == Reference::true_model, tally);
    }
  }
  return tally;
}

TEST(Solids, AreWhereAWalkAlongTheRayMeetsThem) {
  Tally sum;
  for (std::uint32_t seed = 1; seed <= 4; ++seed)
    for (const bool perspective : {true, false})
      for (const bool capped : {true, false}) {
        const Reference kind =
            std::array{Reference::ideal, Reference::snapped, Reference::true_model}[(seed + (capped ? 1 : 0)) % 3];
        SCOPED_TRACE(seed);
        const Tally tally = walk_over(seed, perspective, capped, kind, seed % 2 == 0 ? 8.0 : 1.5);
        EXPECT_EQ(tally.wrong, 0);
        EXPECT_LT(tally.depth_off, 1e-9);
        EXPECT_LT(tally.level_off, 0.01);
        sum.hits += tally.hits;
        sum.misses += tally.misses;
        sum.walked += tally.walked;
        sum.at_near_plane += tally.at_near_plane;
        sum.lit += tally.lit;
      }
  EXPECT_GT(sum.hits, 10000);
  EXPECT_GT(sum.misses, 10000);
  EXPECT_GT(sum.walked, 5000);
  EXPECT_GT(sum.at_near_plane, 2000);
  EXPECT_GT(sum.lit, 5000);
}

// An object in eye space, which is the world.
scene::Scene straight(const scene::ObjectDescription& object, bool perspective = false) {
  scene::CameraDescription camera = camera_of(perspective, 10);
  camera.eye = {0, 0, 10};
  camera.up = {0, 1, 0};
  scene::SceneDescription d = lit_scene(camera);
  d.objects = {object};
  return scene::build_scene(d, "scene.toml", ".");
}

// Parallel rays along the axis: the equation of a ray is linear, or has no depth at all.
TEST(Solids, AlongTheirAxis) {
  const std::size_t middle = (kLines / 2) * kColumns + kColumns / 2;
  const auto rendered = [&](const KnownSolid& known, double tilt_deg) {
    scene::ObjectDescription object = known.object;
    object.rotate_deg = {tilt_deg, 0, 0};
    const scene::Scene scene = straight(object);
    return render(scene, scene::pose(scene, 0, kColumns, kLines), options_of(Reference::ideal, kColumns, kLines));
  };
  const double pixel_size = 5.0 / kLines;
  const double x = 0.5 * pixel_size, square = 2 * x * x;  // of the pixel right below the middle
  for (const double tilt_deg : {0.0, 1e-7}) {             // 2e-9: the leading coefficient is 3e-18
    const auto paraboloid = known_upright(ObjectKind::paraboloid, 1.5, 2.0, true, [](double) { return 0.0; });
    const double z = 2.0 * (1.0 - square / 2.25);
    EXPECT_NEAR(rendered(paraboloid, tilt_deg).depth[middle], (10.0 - z - 1.0) / 19.0, tilt_deg > 0 ? 1e-9 : 1e-14);
    for (const bool capped : {true, false}) {
      const frame::ExactFrame out =
          rendered(known_upright(ObjectKind::cylinder, 1.5, 2.0, capped, [](double) { return 0.0; }), tilt_deg);
      EXPECT_NEAR(out.depth[middle], capped ? (8.0 - 1.0) / 19.0 : 0.0, 1e-9);
      EXPECT_EQ(out.object[middle + 4], 1U);
      EXPECT_EQ(out.object[middle + 6], 0U);  // 1.8 from the axis
    }
  }
}

TEST(Solids, SpheresAreThoseOfTheSphereRenderer) {
  for (const auto& [perspective, cut] : {std::pair(true, false), {false, false}, {true, true}, {false, true}}) {
    scene::SceneDescription d = lit_scene(camera_of(perspective, 8));
    d.lights[1].kind = scene::LightKind::point;
    d.lights[1].position = {2, -4, 1};
    d.objects = {known_sphere(1.2).object, known_sphere(0.7).object};
    d.objects[0].scale = {1.5, 1.5, -1.5};
    d.objects[0].rotate_deg = {20, 30, 40};
    d.objects[1].translate = {0.9, -1.6, 0.4};
    if (cut) d.camera.near = 9.0;  // through both
    const scene::Scene scene = scene::build_scene(d, "scene.toml", ".");
    ASSERT_TRUE(is_of_spheres(scene));
    const scene::Pose pose = scene::pose(scene, 0, 160, 120);
    const frame::ExactFrame out = render(scene, pose, options_of(Reference::true_model, 160, 120));
    const frame::ExactFrame spheres = render_spheres(scene, pose, 160, 120);
    double off = 0.0, depth_off = 0.0;
    for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
      EXPECT_EQ(out.object[pixel], spheres.object[pixel]);
      depth_off = std::max(depth_off, std::fabs(out.depth[pixel] - spheres.depth[pixel]));
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
        off = std::max(off, std::fabs(out.rgb[i] - spheres.rgb[i]));
    }
    EXPECT_LT(off, 1e-9);
    EXPECT_LT(depth_off, 1e-12);
  }
}

// A square through the middle of a sphere, in front of a second one: each of the three is seen where it is nearest, and
// all are counted. The square is object 2 and 3, two triangles.
TEST(Solids, PassThroughTriangles) {
  scene::ObjectDescription square;
  square.kind = ObjectKind::triangles;
  square.positions = {{-2, -2, -1}, {2, -2, -1}, {2, 2, 1}, {-2, -2, -1}, {2, 2, 1}, {-2, 2, 1}};
  scene::Scene scene = straight(known_sphere(1.5).object);
  scene::SceneDescription d = lit_scene(scene.camera);
  d.objects = {known_sphere(1.5).object, square, known_sphere(1.5).object};
  d.objects[2].translate = {0, 0, -0.5};
  d.objects.push_back(d.objects[0]);  // where the first is: hidden by it
  scene = scene::build_scene(d, "scene.toml", ".");
  for (const Reference kind : {Reference::ideal, Reference::snapped, Reference::true_model}) {
    const frame::ExactFrame out =
        render(scene, scene::pose(scene, 0, kColumns, kLines), options_of(kind, kColumns, kLines));
    std::array<int, 6> seen{};
    for (std::size_t pixel = 0; pixel < out.pixels(); ++pixel) {
      const double size = 5.0 / kLines;
      const double x = (static_cast<double>(pixel % kColumns) - (kColumns - 1) / 2.0) * size;
      const std::size_t line = pixel / kColumns;
      const double y = -(static_cast<double>(line) - (kLines - 1) / 2.0) * size;
      const double under = 2.25 - x * x - y * y;
      const bool in_square = std::fabs(x) < 2 && std::fabs(y)<2, in_sphere = under> 0;
      ++seen[out.object[pixel]];
      EXPECT_EQ(out.coverage[pixel], (in_square ? 1U : 0U) + (in_sphere ? 3U : 0U));
      const bool sphere_first = in_sphere && (!in_square || std::sqrt(under) > y / 2);
      if (sphere_first) {
        EXPECT_EQ(out.object[pixel], 1U);
        EXPECT_NEAR(out.depth[pixel], (9.0 - std::sqrt(under)) / 19.0, 1e-12);
      } else if (in_square) {
        EXPECT_TRUE(out.object[pixel] == 2 || out.object[pixel] == 3) << out.object[pixel];
      } else {
        EXPECT_EQ(out.object[pixel], 0U);
      }
    }
    EXPECT_GT(seen[1], 50);
    EXPECT_GT(seen[2] + seen[3], 50);
    EXPECT_EQ(seen[4] + seen[5], 0);
  }
}

// A hole through which its own far side is seen has an outline; an edge between cap and mantle is none, and no edge of
// triangles.
TEST(Solids, Regions) {
  const auto rendered = [](const KnownSolid& known, double tilt_deg) {
    scene::ObjectDescription object = known.object;
    object.rotate_deg = {tilt_deg, 0, 0};
    const scene::Scene scene = straight(object, true);
    return render(scene, scene::pose(scene, 0, 160, 120), options_of(Reference::ideal, 160, 120));
  };
  const auto outlined = [](const frame::ExactFrame& out) {  // pixels within the solid that count as its outline
    int count = 0;
    for (std::size_t y = 3; y + 3 < 120; ++y)
      for (std::size_t x = 3; x + 3 < 160; ++x) {
        bool inside = true;
        for (std::size_t j = y - 3; j <= y + 3; ++j)
          for (std::size_t i = x - 3; i <= x + 3; ++i) inside = inside && out.object[j * 160 + i] != 0;
        if (inside && out.region[y * 160 + x] == frame::Region::silhouettes) ++count;
        EXPECT_EQ(out.edges[y * 160 + x], 0);
      }
    return count;
  };
  const frame::ExactFrame waisted = rendered(known_hyperboloid(1.6, 3.0, 0.3, 1, true), -35);
  EXPECT_GT(outlined(waisted), 40);
  const frame::ExactFrame cylinder =
      rendered(known_upright(ObjectKind::cylinder, 1.2, 2.0, true, [](double) { return 0.0; }), -40);
  EXPECT_EQ(outlined(cylinder), 0);
  EXPECT_GT(std::count(cylinder.region.begin(), cylinder.region.end(), frame::Region::silhouettes), 200);
  EXPECT_GT(std::count(cylinder.region.begin(), cylinder.region.end(), frame::Region::inside), 1000);
  const frame::ExactFrame ball = rendered(known_sphere(1.5), 0);
  EXPECT_GT(std::count(ball.region.begin(), ball.region.end(), frame::Region::highlights), 50);
}

// What is outside of the box is not seen; spheres and ellipsoids have one that fits.
TEST(Solids, AreSeenInTheirBoxesAlone) {
  Random random(9);
  int boxed = 0, seen = 0, outside = 0;
  std::size_t spared = 0;
  for (int round = 0; round < 40; ++round)
    for (const KnownSolid& known : one_of_each(random, round % 2 == 0)) {
      scene::SceneDescription d = lit_scene(camera_of(round % 3 != 0, 8));
      d.objects = {known.object};
      const double size = round % 4 == 0 ? 0.01 : 1.0;
      d.objects[0].scale = {size * random.between(0.3, 1.5), size, size};
      d.objects[0].rotate_deg = {random.between(-180, 180), random.between(-180, 180), random.between(-180, 180)};
      d.objects[0].translate = {random.between(-4, 4), random.between(-3, 3), random.between(-3, 3)};
      const scene::Scene scene = scene::build_scene(d, "scene.toml", ".");
      const geometry::Viewport viewport{64, 48};
      const PlacedSolid solid = placed_solids(scene, scene::pose(scene, 0, 64, 48), viewport).at(0);
      const PlacedSolid::Box box = solid.box(viewport);
      const std::size_t pixels = (box.end_column - box.first_column) * (box.end_line - box.first_line);
      if (pixels < 64 * 48) ++boxed;
      for (std::size_t y = 0; y < 48; ++y)
        for (std::size_t x = 0; x < 64; ++x) {
          if (!solid.hit(static_cast<double>(x), static_cast<double>(y))) continue;
          ++seen;
          const bool in = x >= box.first_column && x < box.end_column && y >= box.first_line && y < box.end_line;
          if (!in) ++outside;
        }
      if (known.object.kind == ObjectKind::sphere || known.object.kind == ObjectKind::ellipsoid)
        spared += 64 * 48 - pixels;
    }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(boxed, 60);
  EXPECT_GT(seen, 10000);
  EXPECT_GT(spared, 64U * 48U * 40U);  // half of all
}

// One intersection of a ray with a quadric, where its leading coefficient vanishes.
TEST(DepthsInside, KeepTheirDigitsWhereTheEquationIsLinear) {
  for (const double a : {0.0, 1e-18, -1e-18, 1e-300}) {
    const geometry::DepthIntervals entered = geometry::depths_inside(a, -1.0, 0.6);
    EXPECT_NEAR(a < 0.0 ? entered.second : entered.first, 0.3, 1e-16) << a;  // inside from 0.3 on
    const geometry::DepthIntervals left = geometry::depths_inside(a, 1.0, -0.6);
    EXPECT_NEAR(a < 0.0 ? left.first : left.second, 0.3, 1e-16) << a;  // inside up to 0.3
  }
  EXPECT_FALSE(geometry::depths_inside(0.0, 0.0, 1.0).any);
  EXPECT_TRUE(geometry::depths_inside(0.0, 0.0, -1.0).any);
  EXPECT_FALSE(geometry::depths_inside(1.0, 0.0, 1.0).any);
  EXPECT_TRUE(geometry::depths_inside(-1.0, 0.0, -1.0).any);
}

}  // namespace
}  // namespace rastertlm::reference
