// Where does a point of eye space come out on the screen?
#include "src/geometry/projection.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace rastertlm::geometry {
namespace {

ScreenVertex<double> projected(const glm::dmat4& projection, const glm::dvec3& point, const Viewport& viewport) {
  ClipVertex<double> vertex;
  vertex.position = transform_point<double>(projection, point);
  return to_screen(vertex, viewport);
}

// The screen's outline lies half a pixel outside the outermost samples; y points down.
TEST(Projection, TheViewVolumesEdgesAreHalfAPixelBeyondTheSamples) {
  const glm::dmat4 ortho = glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 11.0);
  const Viewport viewport{640, 480};
  const auto top_left = projected(ortho, {-4, 3, -1}, viewport);
  EXPECT_NEAR(top_left.x, -0.5, 1e-12);
  EXPECT_NEAR(top_left.y, -0.5, 1e-12);
  EXPECT_NEAR(top_left.z, 0.0, 1e-15);
  const auto bottom_right = projected(ortho, {4, -3, -11}, viewport);
  EXPECT_NEAR(bottom_right.x, 639.5, 1e-12);
  EXPECT_NEAR(bottom_right.y, 479.5, 1e-12);
  EXPECT_NEAR(bottom_right.z, 1.0, 1e-15);
  EXPECT_NEAR(projected(ortho, {0, 0, -6}, viewport).z, 0.5, 1e-15);
}

// At distance d a field of view of 90 degrees is 2 d high; depth is f (d - n) / (d (f - n)).
TEST(Projection, PerspectiveByHand) {
  const glm::dmat4 projection = glm::perspectiveRH_ZO(glm::radians(90.0), 1.0, 1.0, 100.0);
  const Viewport viewport{512, 512};
  const auto vertex = projected(projection, {2, 1, -4}, viewport);
  EXPECT_NEAR(vertex.x, 256 + 0.5 * 256 - 0.5, 1e-10);
  EXPECT_NEAR(vertex.y, 256 - 0.25 * 256 - 0.5, 1e-10);
  EXPECT_NEAR(vertex.z, 100.0 * 3 / (4 * 99), 1e-14);
  EXPECT_NEAR(vertex.inverse_w, 0.25, 1e-15);
}

TEST(Projection, TransformsAreThoseOfTheMatrix) {
  glm::dmat4 m;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) m[c][r] = 1 + c * 4 + r;
  EXPECT_EQ(transform_point<double>(m, {2, 3, 5}),
            (glm::dvec4{1 * 2 + 5 * 3 + 9 * 5 + 13, 2 * 2 + 6 * 3 + 10 * 5 + 14, 3 * 2 + 7 * 3 + 11 * 5 + 15,
                        4 * 2 + 8 * 3 + 12 * 5 + 16}));
  EXPECT_EQ(transform_normal<double>(glm::dmat3(m), {2, 3, 5}),
            (glm::dvec3{1 * 2 + 5 * 3 + 9 * 5, 2 * 2 + 6 * 3 + 10 * 5, 3 * 2 + 7 * 3 + 11 * 5}));
}

}  // namespace
}  // namespace rastertlm::geometry
