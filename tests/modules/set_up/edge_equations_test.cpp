// Edges of triangles of every family: the sign bits are the exact top-left coverage, and no word wraps on the screen.
#include "modules/set_up/edge_equations.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "modules/set_up/pieces.h"
#include "tests/modules/set_up/triangles.h"

namespace rastertlm::set_up::test {
namespace {

struct Tally {
  std::int64_t drawn = 0;
  std::int64_t covered = 0;
  std::int64_t wrong = 0;
  std::int64_t wrapped = 0;
};

// Every pixel of the screen, not of the triangle only: an edge that wraps would show a ghost elsewhere.
void compare_coverage(const Triangle& triangle, const geometry::SnapGrid& grid, const WordFormat& format,
                      Tally& tally) {
  const SetUpResult result = set_up_triangle(triangle, 0, true, grid, format);
  const Points points = snapped(triangle, grid.fraction_bits);
  if (result.outcome != Outcome::drawn) {
    EXPECT_EQ(geometry::doubled_area(points[0], points[1], points[2]), 0);
    EXPECT_EQ(result.words, object_processor::parked_triangle(static_cast<unsigned>(format.word_bits)));
    return;
  }
  ++tally.drawn;
  for (const LinearWords& edge : result.words.edges) tally.wrapped += wraps_on_screen(edge, format) ? 1 : 0;
  const std::uint64_t sign = std::uint64_t{1} << (format.word_bits - 1);
  for (std::size_t y = 0; y < format.lines; ++y) {
    const Span span = crossed_span(points, grid.fraction_bits, static_cast<std::int64_t>(y));
    std::array<std::uint64_t, 3> word{};
    for (std::size_t e = 0; e < 3; ++e) word[e] = word_at(result.words.edges[e], 0, y, format.word_bits);
    for (std::int64_t x = 0; x < static_cast<std::int64_t>(format.columns); ++x) {
      const bool covered = ((word[0] | word[1] | word[2]) & sign) == 0;
      tally.covered += covered ? 1 : 0;
      tally.wrong += covered != (x >= span.begin && x < span.end) ? 1 : 0;
      for (std::size_t e = 0; e < 3; ++e) word[e] += result.words.edges[e].a;
    }
  }
}

WordFormat square(std::size_t n, EdgeForm edges = EdgeForm::snapped) { return {24, n, n, edges}; }

class SnappedEdges : public testing::TestWithParam<std::size_t> {};

TEST_P(SnappedEdges, AreExactOnTheFineGrid) {
  const WordFormat format = square(GetParam());
  const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, -1);
  ASSERT_TRUE(grids);
  Generator generator(11);
  Tally tally;
  for (const Family family : kOnScreen)
    for (int i = 0; i < 60; ++i)
      compare_coverage(generator.triangle(family, static_cast<double>(format.columns)), grids->on_screen, format,
                       tally);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.wrapped, 0);
  EXPECT_GT(tally.drawn, 200);
  EXPECT_GT(tally.covered, 1'000'000);
}

TEST_P(SnappedEdges, AreExactAfterClippingToTheGuardBand) {
  const WordFormat format = square(GetParam());
  const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, -1);
  ASSERT_TRUE(grids);
  const geometry::FrameGrid frame = geometry::frame_grid(*grids, true, viewport(format));
  Generator generator(12);
  Tally tally;
  for (const Family family : kAll)
    for (int i = 0; i < 50; ++i) {
      const Triangle t = generator.triangle(family, static_cast<double>(format.columns));
      const geometry::ClipTriangle<double> clip{to_clip(t[0], format), to_clip(t[1], format), to_clip(t[2], format)};
      const Pieces<double> cut = pieces(clip, frame, viewport(format));
      for (const Triangle& piece : cut.list()) compare_coverage(piece, frame.grid, format, tally);
    }
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.wrapped, 0);
  EXPECT_GT(tally.drawn, 250);
}

INSTANTIATE_TEST_SUITE_P(Screens, SnappedEdges, testing::Values(std::size_t{512}, std::size_t{1024}));

// Corners at the limits of the box, where |E| is largest and samples lie exactly on edges.
TEST(SnappedEdges, HoldAtTheCornersOfTheBox) {
  for (const std::size_t n : {std::size_t{512}, std::size_t{1024}}) {
    const WordFormat format = square(n);
    const auto grids = geometry::snap_grids(n, n, format.word_bits, -1);
    ASSERT_TRUE(grids);
    Tally tally;
    for (const geometry::SnapGrid& grid : {grids->on_screen, grids->guarded}) {
      const auto low = -static_cast<double>(grid.guard_x);
      const auto high = static_cast<double>(n) - 1 + static_cast<double>(grid.guard_x);
      const double step = std::ldexp(1.0, -grid.fraction_bits);
      const std::array<std::array<double, 2>, 6> corners{
          {{low, low}, {high, low}, {low, high}, {high, high}, {high - step, high}, {low, low + step}}};
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j)
          for (std::size_t k = 0; k < j; ++k) {
            Triangle t;
            for (std::size_t c = 0; c < 3; ++c) {
              const auto& at = corners[c == 0 ? i : c == 1 ? j : k];
              t[c].x = at[0], t[c].y = at[1];
            }
            compare_coverage(t, grid, format, tally);
          }
    }
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_EQ(tally.wrapped, 0);
  }
}

// Any screen, word and corners on the grid, ties included, against the crossings of the sides.
TEST(SnappedEdges, AreExactOnAnyScreen) {
  EXPECT_TRUE(rc::check("coverage", [] {
    const auto columns = *rc::gen::inRange<std::size_t>(1, 70);
    const auto lines = *rc::gen::inRange<std::size_t>(1, 70);
    const int word_bits = *rc::gen::inRange(18, 33);
    const int cap = *rc::gen::inRange(-1, 4);
    const WordFormat format{word_bits, columns, lines, EdgeForm::snapped};
    const auto grids = geometry::snap_grids(columns, lines, word_bits, cap);
    RC_PRE(grids.has_value());
    const geometry::SnapGrid grid = *rc::gen::arbitrary<bool>() ? grids->on_screen : grids->guarded;
    const std::int64_t one = std::int64_t{1} << grid.fraction_bits;
    Triangle t;
    for (Corner& corner : t) {
      corner.x = static_cast<double>(*rc::gen::inRange<std::int64_t>(
                     -grid.guard_x * one, (static_cast<std::int64_t>(columns) - 1 + grid.guard_x) * one + 1)) /
                 static_cast<double>(one);
      corner.y = static_cast<double>(*rc::gen::inRange<std::int64_t>(
                     -grid.guard_y * one, (static_cast<std::int64_t>(lines) - 1 + grid.guard_y) * one + 1)) /
                 static_cast<double>(one);
    }
    Tally tally;
    compare_coverage(t, grid, format, tally);
    RC_ASSERT(tally.wrong == 0);
    RC_ASSERT(tally.wrapped == 0);
  }));
}

// Walked the other way an edge is the complement, so that every sample is on one side of it.
TEST(ScaledEdges, AreComplementsFromTheOtherSide) {
  Generator generator(13);
  for (const std::size_t n : {std::size_t{512}, std::size_t{1024}}) {
    const WordFormat format = square(n, EdgeForm::scaled);
    for (int i = 0; i < 2000; ++i) {
      const Triangle t = generator.triangle(Family::partly_off, static_cast<double>(n));
      const ScreenPoint<double> p{t[0].x, t[0].y};
      const ScreenPoint<double> q{t[1].x, i % 10 == 0 ? t[0].y : t[1].y};
      const LinearWords there = scaled_edge(p, q, format);
      const LinearWords back = scaled_edge(q, p, format);
      for (int k = 0; k < 20; ++k) {
        const auto x = static_cast<std::uint64_t>(generator.uniform(0.0, static_cast<double>(n)));
        const auto y = static_cast<std::uint64_t>(generator.uniform(0.0, static_cast<double>(n)));
        // E and -E - 1: one of them is negative, whatever E is.
        ASSERT_EQ((word_at(there, x, y, 24) + word_at(back, x, y, 24)) & low_mask(24), low_mask(24));
      }
    }
  }
}

// A pixel on the wrong side of an unsnapped edge is no farther from it than the bound, and nothing wraps.
TEST(ScaledEdges, StayWithinTheirDisplacement) {
  Generator generator(14);
  double worst_512 = 0.0;
  for (const std::size_t n : {std::size_t{512}, std::size_t{1024}}) {
    const WordFormat format = square(n, EdgeForm::scaled);
    std::int64_t beyond = 0;
    std::int64_t wrapped = 0;
    for (const Family family : {Family::small, Family::full_screen, Family::partly_off, Family::sliver})
      for (int i = 0; i < 15; ++i) {
        const Triangle t = generator.triangle(family, static_cast<double>(n));
        const ScreenPoint<double> p{t[0].x, t[0].y};
        const ScreenPoint<double> q{t[1].x, t[1].y};
        const LinearWords words = scaled_edge(p, q, format);
        wrapped += wraps_on_screen(words, format) ? 1 : 0;
        const ScreenPoint<double> anchor = p.x < q.x ? anchor_of_edge(p, q, format) : anchor_of_edge(q, p, format);
        const double length = std::hypot(q.x - p.x, q.y - p.y);
        const double slope =
            std::hypot(static_cast<double>(sign_extend(words.a, 24)), static_cast<double>(sign_extend(words.b, 24)));
        for (std::size_t y = 0; y < n; ++y)
          for (std::size_t x = 0; x < n; ++x) {
            const auto px = static_cast<double>(x);
            const auto py = static_cast<double>(y);
            const double distance = ((q.y - p.y) * (px - p.x) - (q.x - p.x) * (py - p.y)) / length;
            if (negative(word_at(words, x, y, 24), 24) == (distance < 0.0)) continue;
            const double bound = 0.5 * (std::abs(px - anchor.x) + std::abs(py - anchor.y) + 1.0) / slope;
            beyond += std::abs(distance) > bound * 1.000001 ? 1 : 0;
            if (n == 512) worst_512 = std::max(worst_512, std::abs(distance));
          }
      }
    EXPECT_EQ(beyond, 0) << n;
    EXPECT_EQ(wrapped, 0) << n;
  }
  EXPECT_LT(worst_512, 0.5 * (511.0 + 511.0 + 1.0) / 5793.0);
  RecordProperty("worst_displacement_512_px", std::to_string(worst_512));
}

}  // namespace
}  // namespace rastertlm::set_up::test
