// Do loads make the span unit cover exactly the samples of a triangle, in colours within the bound, and what do they
// cost?
#include "modules/set_up/span_load.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modules/set_up/quadratic_solver.h"
#include "modules/span_unit/span_unit.h"
#include "tests/modules/set_up/triangles.h"
#include "tests/support/span_pixels.h"

namespace rastertlm::set_up::test {
namespace {

constexpr std::uint32_t kColumns = 160;
constexpr std::uint32_t kLines = 120;

class SpanLoad : public testing::Test {
 protected:
  std::mt19937_64 random_{9};
  std::int64_t number(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  // Small and large, thin, on samples, level, and reaching over the screen on all sides.
  ColourTriangle triangle() {
    ColourTriangle t;
    t.fraction_bits = static_cast<int>(number(0, 8));
    const std::int64_t one = std::int64_t{1} << t.fraction_bits;
    const std::int64_t size = number(0, 3) == 0 ? 3 * one : 200 * one;
    const std::int64_t x = number(-40, kColumns + 40) * one, y = number(-40, kLines + 40) * one;
    for (auto& corner : t.corners) corner = {x + number(-size, size), y + number(-size, size)};
    if (number(0, 4) == 0) t.corners[1].y = t.corners[2].y;
    if (number(0, 4) == 0)
      for (auto& corner : t.corners) corner = {corner.x / one * one, corner.y / one * one};
    if (number(0, 5) == 0) t.corners[2] = {t.corners[0].x + (t.corners[1].x - t.corners[0].x) / 2 + 1, t.corners[1].y};
    t.object = 1;
    return t;
  }
  static bool has_area(const ColourTriangle& t) {
    return geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2]) != 0;
  }
};

// Calls sink(span, pixels) for every line.
template <class Sink>
void draw(const ColourTriangle& triangle, const span_unit::SpanUnitParameters& parameters, const Sink& sink) {
  span_unit::SpanUnit unit(parameters, kColumns, kLines);
  for (const span_unit::Span& span : unit.draw(span_load(triangle, SpanFormat::of(parameters, kLines))).spans)
    sink(span, rastertlm::test::pixels_of(span, span_unit::pixel_format(parameters)));
}

TEST_F(SpanLoad, CoversTheSamplesOfATriangleAndNoOthers) {
  std::size_t covered = 0;
  for (int round = 0; round < 3000; ++round) {
    const ColourTriangle t = triangle();
    if (!has_area(t)) continue;
    std::vector<Span> spans(kLines);
    draw(t, {}, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels&) {
      spans[span.line] = {span.column, static_cast<std::int64_t>(span.column) + span.count};
      covered += span.count;
    });
    for (std::int64_t line = 0; line < kLines; ++line) {
      const Span whole = crossed_span(t.corners, t.fraction_bits, line);
      const Span seen{std::clamp<std::int64_t>(whole.begin, 0, kColumns),
                      std::clamp<std::int64_t>(whole.end, 0, kColumns)};
      const Span& got = spans[static_cast<std::size_t>(line)];
      if (seen.begin >= seen.end) {
        ASSERT_EQ(got.begin, got.end) << "line " << line;
      } else {
        ASSERT_EQ(got.begin, seen.begin) << "line " << line;
        ASSERT_EQ(got.end, seen.end) << "line " << line;
      }
    }
  }
  EXPECT_GT(covered, 1'000'000U);
}

// Of two triangles beside an edge each sample belongs to exactly one; none is left between the children of a split.
TEST_F(SpanLoad, LeavesNeitherHoleNorDoublePixelAlongAnEdge) {
  for (int round = 0; round < 1000; ++round) {
    ColourTriangle whole = triangle();
    if (!has_area(whole)) continue;
    for (auto& corner : whole.corners) corner = {corner.x * 2, corner.y * 2};
    ++whole.fraction_bits;
    const auto& [a, b, c] = whole.corners;
    const geometry::SnappedPoint middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    ColourTriangle first = whole;
    ColourTriangle second = whole;
    first.corners = {a, middle, c};
    second.corners = {middle, b, c};
    std::vector<int> count(std::size_t{kColumns} * kLines, 0);
    const auto add = [&](const ColourTriangle& t, int what) {
      if (!has_area(t)) return;
      draw(t, {}, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels&) {
        for (std::uint32_t x = 0; x < span.count; ++x) count[span.line * kColumns + span.column + x] += what;
      });
    };
    add(first, 1);
    add(second, 1);
    add(whole, -1);
    ASSERT_TRUE(std::all_of(count.begin(), count.end(), [](int n) { return n == 0; }));
  }
}

// Quadratic through random levels at six points.
void colour(ColourTriangle& t, std::mt19937_64& random) {
  const double unit = std::ldexp(1.0, -t.fraction_bits);
  const auto& [a, b, c] = t.corners;
  const Offsets<double> at{static_cast<double>(b.x - a.x) * unit, static_cast<double>(b.y - a.y) * unit,
                           static_cast<double>(c.x - a.x) * unit, static_cast<double>(c.y - a.y) * unit};
  for (auto& form : t.colour) {
    const auto level = [&] { return static_cast<double>(random() % 256); };
    form = BarycentricSolver<double>(at.x2, at.y2, at.x3, at.y3)
               .solve({level(), level(), level(), level(), level(), level()});
  }
}

// Largest |level - form| of well-shaped triangles, less the half of rounding; colours outside the levels left out.
double largest_error(const span_unit::SpanUnitParameters& parameters, std::mt19937_64& random) {
  double largest = 0.0;
  for (int round = 0; round < 300; ++round) {
    ColourTriangle t;
    t.fraction_bits = 4;
    const auto inside = [&](std::uint32_t limit) { return static_cast<std::int64_t>(random() % (limit * 16)); };
    for (auto& corner : t.corners) corner = {inside(kColumns), inside(kLines)};
    if (std::abs(geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2])) < 256 * 3000) continue;
    colour(t, random);
    const double unit = std::ldexp(1.0, -t.fraction_bits);
    draw(t, parameters, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels& pixels) {
      for (std::uint32_t x = 0; x < span.count; ++x)
        for (unsigned c = 0; c < 3; ++c) {
          const double exact = t.colour[c].at(span.column + x - static_cast<double>(t.corners[0].x) * unit,
                                              span.line - static_cast<double>(t.corners[0].y) * unit);
          if (exact < 1.0 || exact > 254.0) continue;
          const auto level = static_cast<double>(pixels.levels[x] >> (8 * c) & 0xFFU);
          largest = std::max(largest, std::fabs(level - exact) - 0.5);
        }
    });
  }
  return largest;
}

// Along the lattice and with a prestep the start edge errs by what its words round; as published by up to a step of
// colour from a pixel to the next.
TEST_F(SpanLoad, StartEdgesErrAsTheyAreKnownTo) {
  span_unit::SpanUnitParameters parameters;
  const double bound = span_unit::fraction_bound(20, kColumns + 2 * kLines);
  EXPECT_LE(largest_error(parameters, random_), bound);
  parameters.start_edge = span_unit::StartEdge::prestep;
  EXPECT_LE(largest_error(parameters, random_), bound + 0.2);  // 8 bits of a step of up to some 40 levels
  parameters.start_edge = span_unit::StartEdge::published;
  EXPECT_GT(largest_error(parameters, random_), 2.0);
}

TEST_F(SpanLoad, ErrsNoMoreThanItsFractionBitsAllow) {
  for (const std::int64_t bits : {8, 10, 12, 14, 16, 18, 20, 22, 24}) {
    span_unit::SpanUnitParameters parameters;
    parameters.fraction_bits = bits;
    parameters.word_bits = bits + span_unit::kIntegerBits;
    EXPECT_LE(largest_error(parameters, random_), span_unit::fraction_bound(bits, kColumns + 2 * kLines))
        << bits << " bits";
  }
}

// Every constant is 0.49 of its last place off, all the same way: what is shown is off by as much of the bound at every
// pixel.
TEST_F(SpanLoad, AdversarialConstantsReachTheBound) {
  constexpr double kOff = 0.49;
  for (const std::int64_t bits : {8, 10, 12, 14})
    for (const double sign : {-1.0, 1.0}) {
      span_unit::SpanUnitParameters parameters;
      parameters.fraction_bits = bits;
      parameters.word_bits = bits + span_unit::kIntegerBits;
      const double off = sign * std::ldexp(kOff, -static_cast<int>(bits));
      ColourTriangle t;
      t.fraction_bits = 4;
      t.corners = {{{0, 0}, {2 * kColumns * 16, 0}, {0, 2 * kLines * 16}}};
      // 2 T5, 2 T3, T4 are steps of steps; T2 + T5 and T1 + T3 steps. All of them are rounded to nothing, and 128
      // stays.
      for (auto& form : t.colour) form = {127.5 + off, off / 2, off / 2, off / 2, off, off / 2};
      std::size_t shown = 0;
      double largest = 0.0;
      draw(t, parameters, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels& pixels) {
        for (std::uint32_t x = 0; x < span.count; ++x) {
          const std::uint32_t steps = span.line + span.column + x;
          const double given = t.colour[1].at(span.column + x, span.line);
          const double error = std::fabs((pixels.levels[x] >> 8 & 0xFFU) - 0.5 - given);
          const double bound = span_unit::fraction_bound(bits, steps);
          ASSERT_LE(error, bound);
          ASSERT_NEAR(error, 2 * kOff * bound, 1e-9);
          largest = std::max(largest, error);
          ++shown;
        }
      });
      EXPECT_EQ(shown, kColumns * kLines);
      EXPECT_NEAR(largest, 2 * kOff * span_unit::fraction_bound(bits, kColumns - 1 + kLines - 1), 1e-9);
    }
}

// Pixels left of the screen are stepped over and their rounding adds up: the bound counts them.
TEST_F(SpanLoad, ErrsNoMoreLeftOfTheScreen) {
  span_unit::SpanUnitParameters parameters;
  parameters.fraction_bits = 8;
  parameters.word_bits = 30;
  const double on_screen = span_unit::fraction_bound(8, kColumns + 2 * kLines);
  const double bound = span_unit::fraction_bound(8, span_unit::longest_iteration(parameters, kColumns, kLines));
  double largest = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    ColourTriangle t;
    t.fraction_bits = 4;
    t.corners = {{{-160 * 16, 0}, {160 * 16, 0}, {-162 * 16, 120 * 16 - 8}}};
    // Every constant is 0.49 of its last place away from what its word holds.
    for (auto& form : t.colour) {
      const double off = sign * 0.49 / 256.0;
      form.t0 = 128.0 - 0.5 + off;
      form.t5 = off / 2;
      form.t2 = form.t5;
      form.t4 = off;
      form.t3 = off / 2;
      form.t1 = off;
    }
    draw(t, parameters, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels& pixels) {
      for (std::uint32_t x = 0; x < span.count; ++x) {
        const double exact = t.colour[0].at(span.column + x + 160.0, span.line);
        if (exact < 0.0 || exact > 255.0) continue;
        largest = std::max(largest, std::fabs(static_cast<double>(pixels.levels[x] & 0xFFU) - exact) - 0.5);
      }
    });
  }
  EXPECT_GT(largest, on_screen / 2);
  EXPECT_LE(largest, bound);
}

// A sliver's colours change by hundreds of levels a pixel: sums wrap without harm, a prestep's products do not.
TEST_F(SpanLoad, TellsWhereAPrestepCannotMultiply) {
  ColourTriangle t;
  t.fraction_bits = 4;
  t.corners = {{{0, 0}, {1, 1600}, {0, 3200}}};
  t.colour[1].t2 = 4000.0;
  span_unit::SpanUnitParameters parameters;
  EXPECT_FALSE(span_load(t, SpanFormat::of(parameters, kLines)).wraps);
  parameters.start_edge = span_unit::StartEdge::prestep;
  EXPECT_TRUE(span_load(t, SpanFormat::of(parameters, kLines)).wraps);
  t.colour[1].t2 = 2000.0;  // 12.20: below 2048
  EXPECT_FALSE(span_load(t, SpanFormat::of(parameters, kLines)).wraps);
  t.depth = {0.0, 9'000'000.0, 0.0};  // 24.8: below 2^23 a pixel
  EXPECT_TRUE(span_load(t, SpanFormat::of(parameters, kLines)).wraps);
}

TEST_F(SpanLoad, DepthErrsByHalfABitAStep) {
  for (int round = 0; round < 300; ++round) {
    ColourTriangle t = triangle();
    if (std::abs(geometry::doubled_area(t.corners[0], t.corners[1], t.corners[2])) <
        (std::int64_t{4} << 2 * t.fraction_bits))
      continue;
    for (double& depth : t.depth) depth = uniform(1e6, 15e6);
    const double unit = std::ldexp(1.0, -t.fraction_bits);
    const geometry::SnappedPoint a = t.corners[0], b = t.corners[1], c = t.corners[2];
    const double area = static_cast<double>(geometry::doubled_area(a, b, c)) * unit * unit;
    draw(t, {}, [&](const span_unit::Span& span, const rastertlm::test::SpanPixels& stepped) {
      for (std::uint32_t x = 0; x < span.count; ++x) {
        const double px = span.column + x - static_cast<double>(a.x) * unit;
        const double py = span.line - static_cast<double>(a.y) * unit;
        const auto pixels = [unit](std::int64_t steps) { return static_cast<double>(steps) * unit; };
        const double v = (px * pixels(c.y - a.y) - pixels(c.x - a.x) * py) / area;
        const double w = (pixels(b.x - a.x) * py - px * pixels(b.y - a.y)) / area;
        const double exact = t.depth[0] + v * (t.depth[1] - t.depth[0]) + w * (t.depth[2] - t.depth[0]);
        // Shown without its fraction: up to one less; steps of 2^-9 each.
        const double steps = kColumns + 3 * kLines + 200;
        ASSERT_NEAR(stepped.depths[x] + 0.5, exact, 0.5 + steps / 512 + 1e-6 * std::fabs(exact) / 15.0);
      }
    });
  }
}

}  // namespace
}  // namespace rastertlm::set_up::test
