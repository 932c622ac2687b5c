// Do the kernels of eight triangles make the words of the set-up of one, and leave to it what they cannot?
#include "modules/set_up/triangle_kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "modules/set_up/pieces.h"
#include "modules/set_up/triangle_batch.h"
#include "src/geometry/frame_grid.h"
#include "tests/modules/set_up/triangles.h"

namespace rastertlm::set_up::test {
namespace {

class TriangleKernels : public testing::TestWithParam<VectorVariant> {
 protected:
  std::mt19937_64 random_{7};
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int count) { return std::uniform_int_distribution<int>(1, count)(random_) == 1; }

  // On the screen mostly; some beyond the guard band, thin, without area, on samples, or no numbers.
  Triangle triangle(const WordFormat& format, const geometry::SnapGrid& grid) {
    Triangle t;
    const double size = one_in(2) ? uniform(0.0, 20.0) : 2000.0;
    const auto columns = static_cast<double>(format.columns);
    const auto lines = static_cast<double>(format.lines);
    const double x = uniform(0.0, columns), y = uniform(0.0, lines);
    const double outside = one_in(8) ? static_cast<double>(grid.guard_x) + 3.0 : 0.0;
    for (Corner& corner : t) {
      corner.x = std::clamp(x + uniform(-size, size), -outside, columns - 1 + outside);
      corner.y = std::clamp(y + uniform(-size, size), -outside, lines - 1 + outside);
      corner.z = uniform(-0.1, 1.1);
      corner.normal = {uniform(-1.1, 1.1), uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    }
    if (one_in(6)) t[2] = {t[0].x + 0.4 * (t[1].x - t[0].x), t[0].y + 0.4 * (t[1].y - t[0].y), 0.1, 1.0, t[0].normal};
    if (one_in(9)) t[1].x = t[0].x, t[1].y = t[0].y;
    if (one_in(7))
      for (Corner& corner : t) corner.x = std::floor(corner.x), corner.y = std::floor(corner.y);
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    if (one_in(40)) t[1].y = kNoNumber;
    if (one_in(40)) t[0].z = kNoNumber;
    if (one_in(40)) t[2].normal.y = kNoNumber;
    return t;
  }
};

ScreenCorners side_by_side(const std::array<Triangle, kLanes>& triangles) {
  ScreenCorners screen;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& corner = triangles[lane][i];
      screen.x[i][lane] = corner.x;
      screen.y[i][lane] = corner.y;
      screen.z[i][lane] = corner.z;
      for (int component = 0; component < 3; ++component) screen.normal[i][component][lane] = corner.normal[component];
    }
  return screen;
}

Outcome outcome_of(const FittedTriangles& fitted, std::size_t lane) {
  if ((fitted.drawn >> lane & 1U) != 0) return Outcome::drawn;
  return (fitted.turned_away >> lane & 1U) != 0 ? Outcome::back_face : Outcome::degenerate;
}

TEST_P(TriangleKernels, FitTheWordsOfOneByOne) {
  int compared[3] = {0, 0, 0};
  int left = 0;
  for (const WordFormat& format :
       {WordFormat{24, 512, 512, EdgeForm::snapped}, WordFormat{16, 64, 48, EdgeForm::snapped},
        WordFormat{32, 1280, 720, EdgeForm::snapped}, WordFormat{24, 1024, 1024, EdgeForm::snapped}}) {
    const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, 8).value();
    for (const geometry::SnapGrid& grid : {grids.on_screen, grids.guarded}) {
      const auto request = fit_request(grid, format);
      ASSERT_TRUE(request.has_value());
      for (int round = 0; round < 600; ++round) {
        std::array<Triangle, kLanes> triangles;
        for (Triangle& t : triangles) t = triangle(format, grid);
        FittedTriangles fitted;
        triangle_kernels(GetParam()).fit(*request, side_by_side(triangles), fitted);
        ASSERT_EQ(fitted.drawn & fitted.left, 0U);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          if ((fitted.left >> lane & 1U) != 0) {
            ++left;
            continue;
          }
          const SetUpResult one = set_up_triangle(triangles[lane], 5, false, grid, format);
          ASSERT_EQ(outcome_of(fitted, lane), one.outcome);
          ++compared[static_cast<int>(one.outcome)];
          if (one.outcome == Outcome::drawn) {
            object_processor::TriangleWords words;
            take_words(fitted, lane, words);
            words.material = 5;
            ASSERT_EQ(words, one.words);
          }
        }
      }
    }
  }
  EXPECT_GT(compared[static_cast<int>(Outcome::drawn)], 10000);
  EXPECT_GT(compared[static_cast<int>(Outcome::back_face)], 10000);
  EXPECT_GT(compared[static_cast<int>(Outcome::degenerate)], 1000);
  EXPECT_GT(left, 10);  // slopes of slivers, normals that are no numbers
  EXPECT_LT(left, compared[0] / 4);
}

TEST_P(TriangleKernels, TransformAsOneByOne) {
  const WordFormat format;
  const geometry::Viewport viewport{format.columns, format.lines};
  const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, -1).value();
  int inside = 0;
  int outside = 0;
  for (int round = 0; round < 2000; ++round) {
    const glm::dmat4 to_clip = glm::perspectiveRH_ZO(0.6, 1.0, 1.0, 20.0) *
                               glm::translate(glm::dmat4(1.0), {uniform(-1, 1), uniform(-1, 1), uniform(-12, -2)}) *
                               glm::rotate(glm::dmat4(1.0), uniform(0, 6), glm::dvec3(1, 2, 3));
    const glm::dmat3 to_eye = glm::dmat3(glm::rotate(glm::dmat4(1.0), uniform(0, 6), glm::dvec3(3, 2, 1)));
    ObjectCorners object;
    for (auto* block : {&object.position, &object.normal})
      for (auto& corner : *block)
        for (auto& component : corner)
          for (double& value : component) value = uniform(-1.0, 1.0);
    TransformRequest request = transform_request(to_clip, to_eye, grids.on_screen, viewport);
    request.lanes = static_cast<unsigned>(random_()) & kAllLanes;
    if (one_in(3)) request.lanes = kAllLanes;
    ScreenCorners screen;
    for (auto& row : screen.x)
      for (double& value : row) value = -77.0;
    const unsigned found = triangle_kernels(GetParam()).transform(request, object, screen);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((request.lanes >> lane & 1U) == 0) {
        ASSERT_EQ(screen.x[1][lane], -77.0);  // untouched
        ASSERT_EQ(found >> lane & 1U, 0U);
        continue;
      }
      bool all_inside = true;
      std::array<geometry::ScreenVertex<double>, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto of = [&](const double(&v)[3][3][kLanes]) {
          return glm::dvec3(v[i][0][lane], v[i][1][lane], v[i][2][lane]);
        };
        const auto clip = transform_vertex<double>(of(object.position), of(object.normal), to_clip, to_eye);
        all_inside = all_inside && !geometry::needs_guard_band(clip, grids.on_screen, viewport);
        corners[i] = geometry::to_screen(clip, viewport);
      }
      ASSERT_EQ(found >> lane & 1U, all_inside ? 1U : 0U);
      (all_inside ? inside : outside) += 1;
      if (!all_inside) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(screen.x[i][lane]), std::bit_cast<std::uint64_t>(corners[i].x));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(screen.y[i][lane]), std::bit_cast<std::uint64_t>(corners[i].y));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(screen.z[i][lane]), std::bit_cast<std::uint64_t>(corners[i].z));
        ASSERT_EQ(screen.inverse_w[i][lane], corners[i].inverse_w);
        for (int c = 0; c < 3; ++c) ASSERT_EQ(screen.normal[i][c][lane], corners[i].normal[c]);
      }
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

// Edges at scales of their own, and a grid too fine for a double's bits, are set up one by one.
TEST(TriangleBatch, LeavesOtherFormatsAlone) {
  WordFormat format;
  const auto grids = geometry::snap_grids(512, 512, 24, -1).value();
  EXPECT_TRUE(fit_request(grids.on_screen, format).has_value());
  EXPECT_FALSE(fit_request({14, 0, 0}, format).has_value());
  format.edges = EdgeForm::scaled;
  EXPECT_FALSE(fit_request(grids.on_screen, format).has_value());
}

INSTANTIATE_TEST_SUITE_P(Variants, TriangleKernels, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::set_up::test
