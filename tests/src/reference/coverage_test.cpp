// Is coverage exact, and does every sample of a tessellated area belong to exactly one triangle?
#include "src/reference/coverage.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <vector>

#include "tests/src/reference/exact_cover.h"

namespace rastertlm::reference {
namespace {

using testing_support::covers_exactly;
using testing_support::doubled_area;
using Integer = std::int64_t;
std::int64_t whole(std::int64_t low, std::int64_t high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

// A triangle with corners in -band..size+band, of a kind that matters: any, small, or with corners on samples.
std::array<Point<Integer>, 3> any_triangle(Integer size, Integer band, Integer step) {
  std::array<Point<Integer>, 3> t;
  const Integer kind = whole(0, 2);
  const Point<Integer> base{whole(-band, size + band), whole(-band, size + band)};
  for (auto& p : t) {
    if (kind == 0)
      p = {whole(-band, size + band) * step + whole(0, step - 1),
           whole(-band, size + band) * step + whole(0, step - 1)};
    if (kind == 1) p = {base.x * step + whole(-3 * step, 3 * step), base.y * step + whole(-3 * step, 3 * step)};
    if (kind == 2) p = {whole(-band, size + band) * step, whole(-band, size + band) * step};
  }
  if (doubled_area(t) < 0) std::swap(t[1], t[2]);
  return t;
}

RC_GTEST_PROP(CoverageProperty, IntegersGiveTheExactSet, ()) {
  constexpr std::size_t kSize = 24;
  const Integer step = Integer{1} << whole(0, 5);
  const auto t = any_triangle(kSize, 20, step);
  RC_PRE(doubled_area(t) > 0);
  const Coverage<Integer> coverage(t, step);
  const Span lines = coverage.lines(kSize);
  for (Integer y = 0; y < static_cast<Integer>(kSize); ++y) {
    const Span span = y >= lines.begin && y < lines.end ? coverage.span(y, kSize) : Span{};
    for (Integer x = 0; x < static_cast<Integer>(kSize); ++x)
      RC_ASSERT((x >= span.begin && x < span.end) == covers_exactly(t, x * step, y * step));
  }
}

// Where the numbers are small the double form makes no rounding error.
RC_GTEST_PROP(CoverageProperty, DoublesAgreeWithIntegersOnTheGrid, ()) {
  constexpr std::size_t kSize = 24;
  const Integer step = 32;
  const auto t = any_triangle(kSize, 20, step);
  RC_PRE(doubled_area(t) > 0);
  std::array<Point<double>, 3> plain;
  for (std::size_t i = 0; i < 3; ++i) plain[i] = {static_cast<double>(t[i].x) / 32, static_cast<double>(t[i].y) / 32};
  const Coverage<Integer> exact(t, step);
  const Coverage<double> rounded(plain, 1.0);
  const Span lines = exact.lines(kSize);
  for (Integer y = lines.begin; y < lines.end; ++y) {
    const Span a = exact.span(y, kSize);
    const Span b = rounded.span(y, kSize);
    RC_ASSERT(std::max<Integer>(a.end - a.begin, 0) == std::max<Integer>(b.end - b.begin, 0));
    for (Integer x = a.begin; x < a.end; ++x) {
      RC_ASSERT(b.begin <= x && x < b.end);
      RC_ASSERT(exact.weights(x, y) == rounded.weights(x, y));
    }
  }
}

// The weighted mean of the corners is the sample itself.
RC_GTEST_PROP(CoverageProperty, WeightsAreThoseOfTheSample, ()) {
  const auto t = any_triangle(24, 20, 32);
  RC_PRE(doubled_area(t) > 0);
  const Coverage<Integer> coverage(t, 32);
  const Span lines = coverage.lines(24);
  for (Integer y = lines.begin; y < lines.end; ++y) {
    const Span span = coverage.span(y, 24);
    for (Integer x = span.begin; x < span.end; ++x) {
      const auto [b, c] = coverage.weights(x, y);
      RC_ASSERT(b >= 0.0 && c >= 0.0 && b + c <= 1.0 + 1e-15);
      const auto mean = [&](Integer p, Integer q, Integer r) {
        return (1 - b - c) * static_cast<double>(p) + b * static_cast<double>(q) + c * static_cast<double>(r);
      };
      RC_ASSERT(std::abs(mean(t[0].x, t[1].x, t[2].x) - 32.0 * static_cast<double>(x)) < 1e-9);
      RC_ASSERT(std::abs(mean(t[0].y, t[1].y, t[2].y) - 32.0 * static_cast<double>(y)) < 1e-9);
    }
  }
}

// Squares of a bent sheet, each cut along a diagonal; the sheet is larger than the screen. How often each sample is
// covered.
template <class N>
std::vector<int> covered(const std::vector<Point<N>>& sheet, std::size_t side, std::size_t size, N step) {
  std::vector<int> count(size * size);
  const auto add = [&](const std::array<Point<N>, 3>& t) {
    const Coverage<N> coverage(t, step);
    const Span lines = coverage.lines(size);
    for (std::int64_t y = lines.begin; y < lines.end; ++y) {
      const Span span = coverage.span(y, size);
      for (std::int64_t x = span.begin; x < span.end; ++x)
        ++count[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)];
    }
  };
  for (std::size_t j = 0; j + 1 < side; ++j)
    for (std::size_t i = 0; i + 1 < side; ++i) {
      const Point<N>& a = sheet[j * side + i];
      const Point<N>& b = sheet[j * side + i + 1];
      const Point<N>& c = sheet[(j + 1) * side + i + 1];
      const Point<N>& d = sheet[(j + 1) * side + i];
      if ((i + j) % 2 == 0) {
        add({a, b, c});
        add({a, c, d});
      } else {
        add({a, b, d});
        add({b, c, d});
      }
    }
  return count;
}

// Corners displaced by less than half a square, so that no triangle turns over; some corners stay exactly on samples.
template <class N>
std::vector<Point<N>> bent_sheet(std::size_t side, double square, double step, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto displacement = [&] { return (static_cast<double>(random()) / 4294967296.0 - 0.5) * 0.45 * square; };
  std::vector<Point<N>> sheet;
  for (std::size_t j = 0; j < side; ++j)
    for (std::size_t i = 0; i < side; ++i) {
      const bool on_sample = random() % 4 == 0;
      const double x = (static_cast<double>(i) - 2) * square + (on_sample ? 0.0 : displacement());
      const double y = (static_cast<double>(j) - 2) * square + (on_sample ? 0.0 : displacement());
      sheet.push_back({static_cast<N>(x * step), static_cast<N>(y * step)});
    }
  return sheet;
}

TEST(Coverage, EverySampleOfATessellationBelongsToOneTriangle) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    for (const double square : {1.0, 3.0, 7.0}) {
      const std::size_t size = 40;
      const auto side = static_cast<std::size_t>(static_cast<double>(size) / square) + 6;
      for (const int n : covered(bent_sheet<Integer>(side, square, 32, seed), side, size, Integer{32}))
        ASSERT_EQ(n, 1) << "integers, seed " << seed;
      for (const int n : covered(bent_sheet<double>(side, square, 1, seed), side, size, 1.0))
        ASSERT_EQ(n, 1) << "doubles, seed " << seed;
    }
  }
}

// Rounded edge functions too: both sides of an edge that goes through samples, but for rounding.
TEST(Coverage, AnEdgeThroughSamplesButForRoundingIsNeitherOpenNorDouble) {
  const double third = 1.0 / 3;
  for (int k = 1; k < 60; ++k) {
    const Point<double> a{-3 * third * k, -1 * third * k};  // the line y = x / 3 through the samples (3 n, n)
    const Point<double> b{100.0 + 0.3 * k, (100.0 + 0.3 * k) / 3};
    const Point<double> above{50, -200};
    const Point<double> below{50, 200};
    const Coverage<double> upper({above, b, a}, 1.0);
    const Coverage<double> lower({a, b, below}, 1.0);
    for (std::int64_t y = 1; y < 30; ++y) {
      const Span u = upper.span(y, 90);
      const Span l = lower.span(y, 90);
      for (std::int64_t x = 3 * y - 1; x <= 3 * y + 1; ++x)
        ASSERT_EQ((x >= u.begin && x < u.end) + (x >= l.begin && x < l.end), 1) << x << ", " << y;
    }
  }
}

// By hand: the square of samples (1, 1)..(3, 3) has its left and top samples, not its right and bottom ones.
TEST(Coverage, TopLeftByHand) {
  const Coverage<Integer> upper({{{1, 1}, {3, 1}, {3, 3}}}, 1);  // left edge is the diagonal
  const Coverage<Integer> lower({{{1, 1}, {3, 3}, {1, 3}}}, 1);
  const auto expect = [](const Span& span, std::int64_t begin, std::int64_t end) {
    EXPECT_EQ(std::max<std::int64_t>(span.end - span.begin, 0), end - begin);
    if (end > begin) {
      EXPECT_EQ(span.begin, begin);
    }
  };
  expect(upper.span(0, 8), 0, 0);
  expect(upper.span(1, 8), 1, 3);  // the top edge
  expect(upper.span(2, 8), 2, 3);  // (2, 2) on the diagonal, which is a left edge of the upper triangle
  expect(upper.span(3, 8), 0, 0);
  expect(lower.span(1, 8), 0, 0);
  expect(lower.span(2, 8), 1, 2);
  expect(lower.span(3, 8), 0, 0);  // the bottom edge
}

}  // namespace
}  // namespace rastertlm::reference
