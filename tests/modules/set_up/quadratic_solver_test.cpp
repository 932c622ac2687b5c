// Do all solvers find the same quadratic, exactly, and how far are they off in numbers of a machine?
#include "modules/set_up/quadratic_solver.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <string>

#include "src/geometry/counted.h"
#include "tests/modules/set_up/rational.h"

namespace rastertlm::set_up::test {
namespace {

std::mt19937_64& source() {
  static std::mt19937_64 random(5);
  return random;
}
double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(source()); }
int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(source()); }

template <class T>
SixColours<T> six(const std::array<int, 6>& levels) {
  const auto at = [&](std::size_t i) { return T(static_cast<double>(levels[i])); };
  return {at(0), at(1), at(2), at(3), at(4), at(5)};
}
std::array<int, 6> random_levels() {
  std::array<int, 6> levels{};
  for (int& level : levels) level = integer(0, 255);
  return levels;
}

template <class T>
QuadraticForm<T> one(Solver solver, const Offsets<T>& at, const SixColours<T>& colours) {
  return solve<T, 1>(solver, at, {colours})[0];
}

bool same(const QuadraticForm<Rational>& a, const QuadraticForm<Rational>& b) {
  return a.t0 == b.t0 && a.t1 == b.t1 && a.t2 == b.t2 && a.t3 == b.t3 && a.t4 == b.t4 && a.t5 == b.t5;
}

TEST(QuadraticSolver, AllFindTheSameWhereTheyAreDefined) {
  int printed = 0;
  int level = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto c = [] { return Rational(static_cast<double>(integer(-20, 20))); };
    const Offsets<Rational> at{c(), c(), c(), c()};
    if ((at.x2 * at.y3 - at.y2 * at.x3).is_zero()) continue;
    const SixColours<Rational> colours = six<Rational>(random_levels());
    const auto form = one(Solver::barycentric, at, colours);
    const Rational half = Rational::of(1, 2);
    const auto along = [&](const Rational& a, const Rational& b) { return (a + b) * half; };
    const Rational nothing;
    ASSERT_EQ(form.at(nothing, nothing), colours.i1);
    ASSERT_EQ(form.at(at.x2, at.y2), colours.i2);
    ASSERT_EQ(form.at(at.x3, at.y3), colours.i3);
    ASSERT_EQ(form.at(along(at.x2, nothing), along(at.y2, nothing)), colours.i12);
    ASSERT_EQ(form.at(along(at.x3, nothing), along(at.y3, nothing)), colours.i13);
    ASSERT_EQ(form.at(along(at.x2, at.x3), along(at.y2, at.y3)), colours.i23);
    ASSERT_TRUE(same(one(Solver::published_swapped, at, colours), form));
    if (at.y2.is_zero()) {
      ++level;
      EXPECT_THROW(one(Solver::published, at, colours), std::domain_error);
      continue;
    }
    ++printed;
    ASSERT_TRUE(same(one(Solver::published, at, colours), form));
  }
  EXPECT_GT(printed, 2500);
  EXPECT_GT(level, 20);
}

TEST(QuadraticSolver, LinearIsTheQuadraticOfLinearColours) {
  for (int round = 0; round < 200; ++round) {
    const auto c = [] { return Rational(static_cast<double>(integer(-20, 20))); };
    const Offsets<Rational> at{c(), c(), c(), c()};
    if ((at.x2 * at.y3 - at.y2 * at.x3).is_zero()) continue;
    const Rational i1 = c(), i2 = c(), i3 = c();
    const Rational half = Rational::of(1, 2);
    const SixColours<Rational> colours{i1, i2, i3, (i1 + i2) * half, (i1 + i3) * half, (i2 + i3) * half};
    ASSERT_TRUE(same(one(Solver::barycentric, at, colours),
                     LinearSolver<Rational>(at.x2, at.y2, at.x3, at.y3).solve(i1, i2, i3)));
  }
}

__extension__ using Quad = __float128;

// Largest difference in levels between a form, used exactly, and the quadratic through the colours.
template <class T>
double error_of(const QuadraticForm<T>& form, const Offsets<double>& at, const std::array<int, 6>& levels) {
  if (!is_defined(form)) return std::numeric_limits<double>::infinity();
  const QuadraticForm<Quad> exact{as_double(form.t0), as_double(form.t1), as_double(form.t2),
                                  as_double(form.t3), as_double(form.t4), as_double(form.t5)};
  double largest = 0.0;
  constexpr int kParts = 4;
  for (int i = 0; i <= kParts; ++i)
    for (int j = 0; i + j <= kParts; ++j) {
      const Quad v = Quad(i) / kParts, w = Quad(j) / kParts, u = 1 - v - w;
      const Quad true_level = u * (2 * u - 1) * levels[0] + v * (2 * v - 1) * levels[1] + w * (2 * w - 1) * levels[2] +
                              4 * (u * v * levels[3] + u * w * levels[4] + v * w * levels[5]);
      const Quad level = exact.at(v * at.x2 + w * at.x3, v * at.y2 + w * at.y3);
      const Quad off = level < true_level ? true_level - level : level - true_level;
      largest = std::max(largest, static_cast<double>(off));
    }
  return largest;
}

template <class T>
Offsets<T> narrowed(const Offsets<double>& at) {
  return {T(static_cast<float>(at.x2)), T(static_cast<float>(at.y2)), T(static_cast<float>(at.x3)),
          T(static_cast<float>(at.y3))};
}

double longest_side(const Offsets<double>& at) {
  const auto square = [](double x, double y) { return x * x + y * y; };
  return std::sqrt(std::max({square(at.x2, at.y2), square(at.x3, at.y3), square(at.x2 - at.x3, at.y2 - at.y3)}));
}
// Altitude more than a fifth of the longest side.
bool well_shaped(const Offsets<double>& at) {
  const double longest = longest_side(at);
  return std::fabs(at.x2 * at.y3 - at.y2 * at.x3) > 0.2 * longest * longest;
}
// The printed formulas fail near Y2 = 0 whatever the shape: other families keep away from there.
bool away_from_level(const Offsets<double>& at, double share) { return std::fabs(at.y2) > share * longest_side(at); }
constexpr double kShareOfWellShaped = 0.04;
constexpr double kShareOfSlivers = 0.2;

Offsets<double> offsets_in(double size) {
  const auto c = [size] { return uniform(-size, size) - uniform(-size, size); };
  return {c(), c(), c(), c()};
}
Offsets<double> uniform_in(double size) {
  for (;;) {
    const Offsets<double> at = offsets_in(size);
    if (well_shaped(at) && away_from_level(at, kShareOfWellShaped)) return at;
  }
}
// Of any shape with an altitude of a thirtieth of the longest side.
Offsets<double> with_x2(double x2) {
  for (;;) {
    Offsets<double> at = offsets_in(300);
    at.x2 = x2;
    const double longest = longest_side(at);
    if (std::fabs(at.x2 * at.y3 - at.y2 * at.x3) > longest * longest / 30 && away_from_level(at, kShareOfWellShaped))
      return at;
  }
}
Offsets<double> with_y2(double y2) {
  for (;;) {
    Offsets<double> at = offsets_in(300);
    at.y2 = y2;
    if (well_shaped(at)) return at;
  }
}

Offsets<double> any_sliver(double aspect) {
  const double side = uniform(100, 500);
  const double angle = uniform(0, 6.283185307179586);
  const double along = uniform(0, 1);
  const double x[3] = {0, side, along * side};
  const double y[3] = {0, 0, side / aspect};
  const int first = integer(0, 2);
  const int second = (first + integer(1, 2)) % 3;
  const int third = 3 - first - second;
  const auto turned = [&](int i, double& px, double& py) {
    const double dx = x[i] - x[first], dy = y[i] - y[first];
    px = std::cos(angle) * dx - std::sin(angle) * dy;
    py = std::sin(angle) * dx + std::cos(angle) * dy;
  };
  Offsets<double> at{};
  turned(second, at.x2, at.y2);
  turned(third, at.x3, at.y3);
  return at;
}
Offsets<double> sliver(double aspect) {
  for (;;) {
    const Offsets<double> at = any_sliver(aspect);
    if (away_from_level(at, kShareOfSlivers)) return at;
  }
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// The table of the measurements that this machine was specified by: largest error of 4000 triangles in levels.
struct Family {
  const char* name;
  std::function<Offsets<double>()> make;
  double published_f32, barycentric_f32, published_f64, barycentric_f64;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"well shaped 300 px", [] { return uniform_in(300); }, 0.021, 0.0011, 3.7e-11, 1.9e-12},
      {"X2 = 0", [] { return with_x2(0); }, 0.030, 0.024, 7e-11, 5e-11},
      {"Y2 = 1 px", [] { return with_y2(1); }, 16.5, 0.0045, 2e-8, 5e-12},
      {"Y2 = 0.1", [] { return with_y2(0.1); }, 1330, 0.0036, 2.2e-6, 7e-12},
      {"Y2 = 0.001", [] { return with_y2(1e-3); }, 1.1e7, 0.0025, 0.019, 5e-12},
      {"Y2 = 0", [] { return with_y2(0); }, kInfinite, 0.0027, kInfinite, 7e-12},
      {"aspect 10", [] { return sliver(10); }, 0.0037, 0.0056, 5e-12, 1.6e-11},
      {"aspect 100", [] { return sliver(100); }, 0.38, 0.60, 6e-10, 1.5e-9},
      {"aspect 1e3", [] { return sliver(1e3); }, 32, 81, 5.8e-8, 1.3e-7},
      {"aspect 1e4", [] { return sliver(1e4); }, 2.5e5, 5.9e3, 6e-6, 1e-5},
      {"aspect 1e6", [] { return sliver(1e6); }, kInfinite, 5.9e7, 0.062, 0.18},
      {"tiny 0.01 px", [] { return uniform_in(0.01); }, 0.022, 0.0014, 2e-11, 2e-12},
      {"huge 1e6 px", [] { return uniform_in(1e6); }, 0.016, 0.0013, 6e-11, 2e-12},
      {"huge 1e7 px", [] { return uniform_in(1e7); }, kInfinite, 0.0012, 4e-11, 2e-12},
  };
  return all;
}

// Within a factor of 10 of the table; where that is infinite, this is or is absurd.
void expect_near(double measured, double given, const std::string& what) {
  if (given == kInfinite) {
    EXPECT_GT(measured, 1e6) << what;
    return;
  }
  EXPECT_LT(measured, 10 * given) << what;
  EXPECT_GT(measured, given / 10) << what;
}

TEST(QuadraticSolver, ErrsAsItsNumbersLetIt) {
  for (const Family& family : families()) {
    double error[4] = {0, 0, 0, 0};
    for (int round = 0; round < 4000; ++round) {
      const Offsets<double> at = narrowed<double>(family.make());
      if (at.x2 * at.y3 - at.y2 * at.x3 == 0.0) continue;
      const std::array<int, 6> levels = random_levels();
      const auto keep = [&](double& into, const auto& form) { into = std::max(into, error_of(form, at, levels)); };
      keep(error[0], one(Solver::published, narrowed<float>(at), six<float>(levels)));
      keep(error[1], one(Solver::barycentric, narrowed<float>(at), six<float>(levels)));
      keep(error[2], one(Solver::published, at, six<double>(levels)));
      keep(error[3], one(Solver::barycentric, at, six<double>(levels)));
    }
    const std::string name = family.name;
    std::printf("%-20s published f32 %9.2g  barycentric f32 %9.2g  published f64 %9.2g  barycentric f64 %9.2g\n",
                family.name, error[0], error[1], error[2], error[3]);
    expect_near(error[0], family.published_f32, name + ", published, float");
    expect_near(error[1], family.barycentric_f32, name + ", barycentric, float");
    expect_near(error[2], family.published_f64, name + ", published, double");
    expect_near(error[3], family.barycentric_f64, name + ", barycentric, double");
  }
}

TEST(QuadraticSolver, ExchangingCornersHelpsNearAHorizontalEdge) {
  double printed = 0.0;
  double exchanged_corners = 0.0;
  for (int round = 0; round < 1000; ++round) {
    const Offsets<double> at = narrowed<double>(with_y2(0.1));
    const std::array<int, 6> levels = random_levels();
    printed = std::max(printed, error_of(one(Solver::published, narrowed<float>(at), six<float>(levels)), at, levels));
    exchanged_corners =
        std::max(exchanged_corners,
                 error_of(one(Solver::published_swapped, narrowed<float>(at), six<float>(levels)), at, levels));
  }
  EXPECT_GT(printed, 100 * exchanged_corners);
}

// Operations of one channel and of three, counted by the code itself.
TEST(QuadraticSolver, CountsItsOperations) {
  using Number = geometry::Counted<double>;
  const Offsets<Number> at{3.0, 1.0, -2.0, 5.0};
  const SixColours<Number> colours{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const auto counted = [&](Solver solver, auto channels) {
    std::array<SixColours<Number>, decltype(channels)::value> all;
    all.fill(colours);
    const geometry::OperationCounts before = geometry::operation_counts;
    solve<Number>(solver, at, all);
    return geometry::operation_counts - before;
  };
  const auto one_channel = counted(Solver::barycentric, std::integral_constant<std::size_t, 1>{});
  const auto three = counted(Solver::barycentric, std::integral_constant<std::size_t, 3>{});
  const auto channel_add = (three.add - one_channel.add) / 2;
  const auto channel_multiply = (three.multiply - one_channel.multiply) / 2;
  std::printf("barycentric: a channel %lu additions, %lu multiplications; shared %lu, %lu, %lu divisions\n",
              channel_add, channel_multiply, one_channel.add - channel_add, one_channel.multiply - channel_multiply,
              one_channel.divide);
  EXPECT_EQ(one_channel.divide, 1U);
  EXPECT_EQ(three.divide, 1U);
  const auto printed = counted(Solver::published, std::integral_constant<std::size_t, 1>{});
  std::printf("published: %lu additions, %lu multiplications, %lu divisions\n", printed.add, printed.multiply,
              printed.divide);
  EXPECT_EQ(printed.divide, 5U);  // as the paper counts
}

// A number of 64 bits with its point anywhere gives what it can hold, or nothing.
TEST(QuadraticSolver, FixedNumbersSayWhereTheyDoNotReach) {
  using Fixed = FixedNumber<40>;
  const Offsets<double> at{100, 20, -30, 90};
  const std::array<int, 6> levels{10, 200, 30, 140, 50, 160};
  const auto form = one(Solver::barycentric, Offsets<Fixed>{at.x2, at.y2, at.x3, at.y3}, six<Fixed>(levels));
  ASSERT_TRUE(is_defined(form));
  EXPECT_LT(error_of(form, at, levels), 0.01);
  EXPECT_FALSE(is_defined(
      one(Solver::barycentric, Offsets<Fixed>{Fixed(100), Fixed(0), Fixed(50), Fixed(0)}, six<Fixed>(levels))));
  EXPECT_FALSE(is_defined(
      one(Solver::barycentric, Offsets<Fixed>{Fixed(1e6), Fixed(0), Fixed(0), Fixed(1e6)}, six<Fixed>(levels))));
}

// Against exact rational arithmetic, of all signs.
TEST(FixedNumber, QuotientsAndProductsAreNearest) {
  std::mt19937_64 random(5);
  constexpr double kOne = 65536.0;
  const auto raw = [&] { return std::uniform_int_distribution<std::int64_t>(-3'000'000, 3'000'000)(random); };
  for (int round = 0; round < 5000; ++round) {
    const std::int64_t a = raw(), b = raw();
    if (b == 0) continue;
    const FixedNumber<16> x(static_cast<double>(a) / kOne), y(static_cast<double>(b) / kOne);
    // |q b - a 2^16| <= b / 2, with ties upwards; in integers.
    const auto q = static_cast<std::int64_t>((x / y).to_double() * kOne);
    const std::int64_t off = a * 65536 - q * b;
    ASSERT_LE(2 * std::abs(off), std::abs(b)) << a << " / " << b;
    const auto p = static_cast<std::int64_t>((x * y).to_double() * kOne);
    ASSERT_LE(2 * std::abs(a * b - p * 65536), 65536) << a << " * " << b;
  }
}

}  // namespace
}  // namespace rastertlm::set_up::test
