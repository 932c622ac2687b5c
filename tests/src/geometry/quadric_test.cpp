// Quadrics on the screen, against rays that are followed in eye space and know nothing of the screen's forms.
#include "src/geometry/quadric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "src/geometry/counted.h"

namespace rastertlm::geometry {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
  }

 private:
  std::mt19937_64 engine_;
};

struct Shape {
  const char* name;
  glm::dvec4 diagonal;  // of x^2, y^2, z^2, 1
  double z_linear;      // 2 of them in the matrix: q[2][3] = q[3][2]
  bool capped;          // between z = -1 and z = 1
};
constexpr Shape kShapes[] = {
    {"sphere", {1, 1, 1, -1}, 0, false},
    {"ellipsoid", {1, 4, 9, -1}, 0, false},
    {"cylinder", {1, 1, 0, -1}, 0, true},
    {"cone", {1, 1, -1, 0}, 0, true},
    {"paraboloid", {1, 1, 0, -1}, 0.5, true},
    {"hyperboloid of one sheet", {1, 1, -1, -0.2}, 0, true},
    {"hyperboloid of two sheets", {1, 1, -1, 0.2}, 0, true},
};

glm::dmat4 matrix_of(const Shape& shape) {
  glm::dmat4 q(0.0);
  for (int i = 0; i < 4; ++i) q[i][i] = shape.diagonal[i];
  q[2][3] = q[3][2] = shape.z_linear;
  return q;
}

struct Placed {
  glm::dmat4 quadric;              // eye space
  std::vector<glm::dvec4> planes;  // eye space
  glm::dmat4 eye_to_clip;
  Viewport viewport{64, 48};

  double value(const glm::dvec4& x) const { return glm::dot(x, quadric * x); }
  bool inside(const glm::dvec3& at, double slack) const {
    const glm::dvec4 x(at, 1.0);
    if (value(x) > slack) return false;
    for (const glm::dvec4& plane : planes)
      if (glm::dot(plane, x) > slack) return false;
    return true;
  }
};

Placed placed(const Shape& shape, bool perspective, Random& random) {
  glm::dmat4 to_eye(1.0);
  to_eye = glm::translate(to_eye, glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-9, -4)));
  const glm::dvec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1));
  to_eye = glm::rotate(to_eye, random.uniform(0, 6), glm::normalize(axis));
  to_eye = glm::scale(to_eye, glm::dvec3(random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)));
  Placed result;
  result.quadric = quadric_in_eye_space(matrix_of(shape), to_eye);
  if (shape.capped) {
    const glm::dmat4 back = glm::transpose(glm::inverse(to_eye));
    result.planes = {back * glm::dvec4(0, 0, 1, -1), back * glm::dvec4(0, 0, -1, -1)};
  }
  result.eye_to_clip =
      perspective ? glm::perspectiveRH_ZO(1.0, 4.0 / 3.0, 1.0, 20.0) : glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 20.0);
  return result;
}

glm::dvec3 eye_point(const glm::dmat4& screen_to_eye, double column, double line, double depth) {
  const glm::dvec4 x = screen_to_eye * glm::dvec4(column, line, depth, 1.0);
  return glm::dvec3(x) / x.w;
}

struct Forms {
  glm::dmat4 screen_to_eye;
  ScreenQuadric<double> quadric;
  std::vector<ScreenPlane<double>> planes;
};

Forms forms_of(const Placed& object) {
  Forms forms;
  forms.screen_to_eye = glm::inverse(eye_to_screen(object.eye_to_clip, object.viewport));
  forms.quadric = screen_quadric<double>(object.quadric, forms.screen_to_eye);
  for (const glm::dvec4& plane : object.planes)
    forms.planes.push_back(screen_plane<double>(plane, forms.screen_to_eye));
  return forms;
}

TEST(ScreenQuadric, PixelsGoWhereVerticesGo) {
  Random random(1);
  const Viewport viewport{64, 48};
  for (const glm::dmat4& clip :
       {glm::perspectiveRH_ZO(1.0, 4.0 / 3.0, 1.0, 20.0), glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 20.0)})
    for (int round = 0; round < 100; ++round) {
      const glm::dvec3 at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-19, -2));
      const ScreenVertex<double> vertex = to_screen(ClipVertex<double>{clip * glm::dvec4(at, 1.0), {}}, viewport);
      const glm::dvec4 screen = eye_to_screen(clip, viewport) * glm::dvec4(at, 1.0);
      EXPECT_NEAR(screen.x / screen.w, vertex.x, 1e-10);
      EXPECT_NEAR(screen.y / screen.w, vertex.y, 1e-10);
      EXPECT_NEAR(screen.z / screen.w, vertex.z, 1e-12);
    }
}

// Marches along the ray: the hit is inside, and nothing before it is.
TEST(ScreenQuadric, FindsWhatMarchingAlongTheRayFinds) {
  Random random(2);
  int hits = 0, misses = 0, wrong = 0;
  std::array<int, 4> of_surface{};
  for (const Shape& shape : kShapes)
    for (int round = 0; round < 24; ++round) {
      const Placed object = placed(shape, round % 2 == 0, random);
      const Forms forms = forms_of(object);
      for (int ray = 0; ray < 40; ++ray) {
        const double x = random.uniform(12, 51), y = random.uniform(8, 39);
        const auto hit = first_hit(forms.quadric, forms.planes, x, y);
        ++(hit ? hits : misses);
        if (hit) ++of_surface[static_cast<std::size_t>(hit->surface)];
        const double end = hit ? hit->depth - 1e-7 : 1.0;
        for (int step = 0; step < 300; ++step) {
          const double depth = (step + 0.5) / 300;
          if (depth < end && object.inside(eye_point(forms.screen_to_eye, x, y, depth), -1e-9)) ++wrong;
        }
        if (hit && !object.inside(eye_point(forms.screen_to_eye, x, y, hit->depth), 1e-9)) ++wrong;
      }
    }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 1000);
  for (const QuadricHit::Surface surface : {QuadricHit::Surface::near_root, QuadricHit::Surface::plane})
    EXPECT_GT(of_surface[static_cast<std::size_t>(surface)], 100);
}

// The gradient of the quadric at the point itself.
TEST(ScreenQuadric, NormalsAreTheGradients) {
  Random random(3);
  int seen = 0;
  for (const Shape& shape : kShapes)
    for (int round = 0; round < 24; ++round) {
      const Placed object = placed(shape, round % 2 == 0, random);
      const Forms forms = forms_of(object);
      for (int ray = 0; ray < 20; ++ray) {
        const double x = random.uniform(12, 51), y = random.uniform(8, 39);
        const auto hit = first_hit(forms.quadric, forms.planes, x, y);
        if (!hit || hit->surface == QuadricHit::Surface::plane || hit->surface == QuadricHit::Surface::near_plane)
          continue;
        const glm::dvec4 at(eye_point(forms.screen_to_eye, x, y, hit->depth), 1.0);
        const glm::dvec3 gradient(object.quadric * at);
        const glm::dvec3 normal = quadric_normal(forms.quadric, hit->surface, x, y);
        EXPECT_GT(glm::dot(glm::normalize(normal), glm::normalize(gradient)), 1 - 1e-9) << shape.name;
        ++seen;
      }
    }
  EXPECT_GT(seen, 300);
}

// The eye within a solid: it is cut at the near plane, all over the screen.
TEST(ScreenQuadric, TheEyeInsideSeesTheNearPlanesCut) {
  Placed object;
  object.quadric = quadric_in_eye_space(matrix_of(kShapes[0]), glm::scale(glm::dmat4(1.0), glm::dvec3(8.0)));
  object.eye_to_clip = glm::perspectiveRH_ZO(1.0, 4.0 / 3.0, 1.0, 20.0);
  const Forms forms = forms_of(object);
  EXPECT_LT(forms.quadric.a, 0.0);
  for (const double x : {0.0, 31.5, 63.0})
    for (const double y : {0.0, 23.5, 47.0}) {
      const auto hit = first_hit(forms.quadric, forms.planes, x, y);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->surface, QuadricHit::Surface::near_plane);
      EXPECT_EQ(hit->depth, 0.0);
    }
}

// Parallel rays along a cylinder never meet its side.
TEST(ScreenQuadric, ACylinderAlongTheRaysHasNoForm) {
  Placed object;
  object.quadric = quadric_in_eye_space(matrix_of(kShapes[2]), glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -5)));
  object.eye_to_clip = glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 20.0);
  EXPECT_EQ(forms_of(object).quadric.a, 0.0);
}

TEST(ScreenPlane, AlongTheRaysKeepsASide) {
  const glm::dmat4 screen_to_eye =
      glm::inverse(eye_to_screen(glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 20.0), Viewport{64, 48}));
  const ScreenPlane<double> plane = screen_plane<double>({1, 0, 0, 0}, screen_to_eye);
  EXPECT_EQ(plane.keeps, ScreenPlane<double>::Keeps::side);
  EXPECT_LE(plane.depth.at(10, 5), 0.0);
  EXPECT_GT(plane.depth.at(50, 5), 0.0);
}

// What a host would do a quadric and frame, matrices from object to screen apart.
TEST(ScreenQuadric, CountsItsOperations) {
  Random random(4);
  const Placed object = placed(kShapes[1], true, random);
  const glm::dmat4 back = glm::inverse(eye_to_screen(object.eye_to_clip, object.viewport));
  const OperationCounts before = operation_counts;
  screen_quadric<Counted<double>>(object.quadric, back);
  const OperationCounts used = operation_counts - before;
  EXPECT_EQ(used.multiply, 64U + 40U + 27U);
  EXPECT_EQ(used.divide, 1U);
}

}  // namespace
}  // namespace rastertlm::geometry
