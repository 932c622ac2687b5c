// Planes of depth and normal: at every covered pixel within their bound of the exact plane through the snapped corners.
#include "modules/set_up/plane_equations.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "modules/set_up/pieces.h"
#include "tests/modules/set_up/triangles.h"

namespace rastertlm::set_up::test {
namespace {

struct Worst {
  double over_bound = -1e300;  // error less its bound, units of the word
  double depth_error = 0.0;
  double normal_error = 0.0;
  std::int64_t pixels = 0;
  std::int64_t outside_range = 0;  // depth words that left 0 .. 2^W - 2: they would have wrapped, or passed for nothing
};

// Weights of the corners at a sample: exact integers over the area, then one division.
std::array<long double, 3> barycentric(const Points& points, int q, std::int64_t x, std::int64_t y) {
  const geometry::SnappedPoint p{x << q, y << q};
  const auto area = static_cast<long double>(geometry::doubled_area(points[0], points[1], points[2]));
  return {static_cast<long double>(geometry::doubled_area(p, points[1], points[2])) / area,
          static_cast<long double>(geometry::doubled_area(points[0], p, points[2])) / area,
          static_cast<long double>(geometry::doubled_area(points[0], points[1], p)) / area};
}

// Covered pixels from `first` on, both ways. A back face is expected to have its normals turned.
void compare_planes(const Triangle& triangle, const geometry::SnapGrid& grid, const WordFormat& format, Worst& worst,
                    std::int64_t first = 0) {
  const SetUpResult result = set_up_triangle(triangle, 0, true, grid, format);
  if (result.outcome != Outcome::drawn) return;
  const int q = grid.fraction_bits;
  const Points points = snapped(triangle, q);
  const auto bits = static_cast<unsigned>(format.word_bits);
  const auto columns = static_cast<std::int64_t>(format.columns);
  const auto lines = static_cast<std::int64_t>(format.lines);
  const auto xs = std::minmax({points[0].x, points[1].x, points[2].x});
  const auto ys = std::minmax({points[0].y, points[1].y, points[2].y});
  const double bound = 0.5 * (std::ldexp(static_cast<double>(xs.second - xs.first + ys.second - ys.first), -q) / 2 + 1);
  const double unit =
      std::ldexp(geometry::doubled_area(points[0], points[1], points[2]) < 0 ? 1.0 : -1.0, format.word_bits - 2);
  const double m = std::ceil(static_cast<double>(columns + lines) / 4) + 1;
  const double range = std::ldexp(1.0, format.word_bits) - 2 - 2 * m;
  for (std::int64_t y = std::max<std::int64_t>(first, ys.first >> q); y < std::min(lines, (ys.second >> q) + 1); ++y) {
    const Span span = crossed_span(points, q, y);
    for (std::int64_t x = std::max<std::int64_t>(first, span.begin); x < std::min(columns, span.end); ++x) {
      const auto weight = barycentric(points, q, x, y);
      ++worst.pixels;
      const auto exact = [&](const auto& value) {
        return weight[0] * static_cast<long double>(value(triangle[0])) +
               weight[1] * static_cast<long double>(value(triangle[1])) +
               weight[2] * static_cast<long double>(value(triangle[2]));
      };
      const auto ux = static_cast<std::uint64_t>(x);
      const auto uy = static_cast<std::uint64_t>(y);
      const std::uint64_t depth = word_at(result.words.depth, ux, uy, format.word_bits);
      const double depth_error = std::abs(static_cast<double>(static_cast<long double>(depth) -
                                                              exact([&](const Corner& c) { return c.z * range + m; })));
      worst.outside_range += depth == low_mask(bits) || depth_error > range / 2 ? 1 : 0;
      worst.depth_error = std::max(worst.depth_error, depth_error);
      worst.over_bound = std::max(worst.over_bound, depth_error - bound);
      for (int i = 0; i < 3; ++i) {
        const std::int64_t word =
            sign_extend(word_at(result.words.normals[static_cast<std::size_t>(i)], ux, uy, format.word_bits), bits);
        const double error = std::abs(static_cast<double>(static_cast<long double>(word) -
                                                          exact([&](const Corner& c) { return c.normal[i] * unit; })));
        worst.normal_error = std::max(worst.normal_error, error);
        worst.over_bound = std::max(worst.over_bound, error - bound);
      }
    }
  }
}

class Planes : public testing::TestWithParam<std::size_t> {};

// The computation in double adds less than this to the rounding of the three words; only slivers come near it.
constexpr double kDoubleError = 0.01;

TEST_P(Planes, KeepTheirBoundOnTheFineGrid) {
  const std::size_t n = GetParam();
  const WordFormat format{24, n, n};
  const auto grids = geometry::snap_grids(n, n, 24, -1);
  ASSERT_TRUE(grids);
  Generator generator(21);
  for (const Family family : kOnScreen) {
    Worst worst;
    const int count = family == Family::full_screen ? 12 : family == Family::hundred ? 60 : 400;
    for (int i = 0; i < count; ++i)
      compare_planes(generator.triangle(family, static_cast<double>(n)), grids->on_screen, format, worst);
    EXPECT_LT(worst.over_bound, kDoubleError) << static_cast<int>(family);
    EXPECT_EQ(worst.outside_range, 0) << static_cast<int>(family);
    EXPECT_GT(worst.pixels, 1000);
    RecordProperty("depth_error_" + std::to_string(static_cast<int>(family)), std::to_string(worst.depth_error));
    RecordProperty("normal_error_" + std::to_string(static_cast<int>(family)), std::to_string(worst.normal_error));
  }
}

TEST_P(Planes, KeepTheirBoundAfterClipping) {
  const std::size_t n = GetParam();
  const WordFormat format{24, n, n};
  const auto grids = geometry::snap_grids(n, n, 24, -1);
  ASSERT_TRUE(grids);
  const geometry::FrameGrid frame = geometry::frame_grid(*grids, true, viewport(format));
  Generator generator(22);
  Worst worst;
  for (const Family family : {Family::partly_off, Family::far_off, Family::sliver})
    for (int i = 0; i < (family == Family::sliver ? 200 : 10); ++i) {
      const Triangle t = generator.triangle(family, static_cast<double>(n));
      const geometry::ClipTriangle<double> clip{to_clip(t[0], format), to_clip(t[1], format), to_clip(t[2], format)};
      const Pieces<double> cut = pieces(clip, frame, viewport(format));
      for (const Triangle& piece : cut.list()) compare_planes(piece, frame.grid, format, worst);
    }
  EXPECT_LT(worst.over_bound, kDoubleError);
  EXPECT_EQ(worst.outside_range, 0);
  EXPECT_GT(worst.pixels, 100'000);
}

// Triangles thinner than a step of the screen, a few steps of the grid wide: slopes are many times the word.
TEST_P(Planes, KeepTheirBoundOnTheThinnestSlivers) {
  const std::size_t n = GetParam();
  const WordFormat format{24, n, n};
  const auto grids = geometry::snap_grids(n, n, 24, -1);
  ASSERT_TRUE(grids);
  const double step = std::ldexp(1.0, -grids->on_screen.fraction_bits);
  Generator generator(23);
  Worst worst;
  for (int i = 0; i < 4000; ++i) {
    Triangle t = generator.triangle(Family::full_screen, static_cast<double>(n));
    // An edge through a sample, and the third corner a step or two beside it, so that something is covered.
    t[0].x = std::floor(t[0].x), t[0].y = std::floor(t[0].y);
    t[1].x = 2 * std::floor((t[0].x + t[1].x) / 2) - t[0].x;
    t[1].y = 2 * std::floor((t[0].y + t[1].y) / 2) - t[0].y;
    if (t[1].x < 0 || t[1].y < 0) continue;
    t[2].x = std::floor((t[0].x + t[1].x) / 2 / step) * step + (generator.coin() ? step : 0.0);
    t[2].y = std::floor((t[0].y + t[1].y) / 2 / step) * step + (generator.coin() ? step : 0.0);
    compare_planes(t, grids->on_screen, format, worst);
  }
  // Slopes reach 2^43 and double has 53 bits: up to 2^-9 of a unit a pixel comes on top of the rounding.
  EXPECT_LT(worst.over_bound, static_cast<double>(n) / 512.0);
  EXPECT_EQ(worst.outside_range, 0);
  EXPECT_GT(worst.pixels, 1000);
}

INSTANTIATE_TEST_SUITE_P(Screens, Planes, testing::Values(std::size_t{512}, std::size_t{1024}));

// The worst case for the margin: corners in the guard band, depth on the near and far planes, seen at the screen's
// corners.
TEST(Planes, NeverWrapWithNearAndFarCornersInTheGuardBand) {
  EXPECT_TRUE(rc::check("no wrap", [] {
    const auto n = *rc::gen::elementOf(std::vector<std::size_t>{64, 128, 512});
    const WordFormat format{24, n, n};
    const auto grids = geometry::snap_grids(n, n, 24, -1);
    RC_PRE(grids.has_value());
    const geometry::SnapGrid& grid = grids->guarded;
    const auto size = static_cast<std::int64_t>(n);
    Triangle t;
    for (Corner& corner : t) {
      const auto anywhere = rc::gen::inRange<std::int64_t>(-grid.guard_x, size + grid.guard_x);
      const auto edges =
          rc::gen::elementOf(std::vector<std::int64_t>{-grid.guard_x, 0, size - 1, size - 1 + grid.guard_x});
      corner.x = static_cast<double>(*rc::gen::oneOf(anywhere, edges));
      corner.y = static_cast<double>(*rc::gen::oneOf(anywhere, edges));
      corner.z = *rc::gen::elementOf(std::vector<double>{0.0, 1.0, 0.5});
      for (int i = 0; i < 3; ++i) corner.normal[i] = *rc::gen::elementOf(std::vector<double>{-1.0, 1.0});
    }
    Worst worst;
    compare_planes(t, grid, format, worst);
    RC_ASSERT(worst.outside_range == 0);
    RC_ASSERT(worst.over_bound < kDoubleError);
  }));
}

// A margin of a quarter of the screen is enough only because the anchor is the centre of what is seen: with the centre
// of the whole box, three quarters of a screen away, the rounding of both slopes would take depth over its end.
TEST(Planes, NeverWrapAtTheFarCornerOfABoxThatLeavesTheScreen) {
  const WordFormat format{24, 512, 512};
  const geometry::SnapGrid grid = geometry::snap_grids(512, 512, 24, -1)->guarded;
  ASSERT_EQ(grid.guard_x, 255);
  Generator generator(24);
  Worst worst;
  for (int i = 0; i < 3000; ++i) {
    Triangle t = generator.triangle(Family::full_screen, 512.0);
    const double end = i % 2;
    t[0].x = t[0].y = 511.0, t[0].z = end;
    t[1].x = -255.0, t[1].y = generator.uniform(0.0, 500.0), t[1].z = std::abs(end - generator.uniform(0.0, 1e-3));
    t[2].x = generator.uniform(0.0, 500.0), t[2].y = -255.0, t[2].z = std::abs(end - generator.uniform(0.0, 1e-3));
    compare_planes(t, grid, format, worst, 500);
  }
  EXPECT_EQ(worst.outside_range, 0);
  EXPECT_GT(worst.pixels, 3000);
}

// Scaled edges leave the vertices alone, and the planes take them on a grid of 2^-12 pixel.
TEST(Planes, KeepTheirBoundBesideScaledEdges) {
  const WordFormat format{24, 512, 512, EdgeForm::scaled};
  const geometry::SnapGrid grid{kScaledFractionBits, 0, 0};
  Generator generator(25);
  Worst worst;
  for (const Family family : {Family::small, Family::hundred, Family::full_screen})
    for (int i = 0; i < 10; ++i) compare_planes(generator.triangle(family, 512.0), grid, format, worst);
  EXPECT_LT(worst.over_bound, kDoubleError);
  EXPECT_EQ(worst.outside_range, 0);
  EXPECT_GT(worst.pixels, 100'000);
}

TEST(Planes, GoBetweenTheMarginsOfNearAndFar) {
  const WordFormat format{24, 512, 512};
  EXPECT_EQ(depth_margin(format), 257);
  EXPECT_EQ(near_depth(format), 257);
  EXPECT_EQ(far_depth(format), 16777216 - 2 - 257);
  EXPECT_EQ(depth_margin({24, 3, 2}), 3);  // ceil(5 / 4) + 1
  EXPECT_EQ(normal_unit(format), 1 << 22);
}

}  // namespace
}  // namespace rastertlm::set_up::test
