// Against the C library in long double (64 bits of fraction, its own error well below ours), over pseudo-random
// arguments and at the places where a reduction changes its mind.
#include "src/base/mathematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace m = rastertlm::mathematics;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// In units of the last place of the exact value (a normal number).
double error_ulp(double value, long double exact) {
  const double nearest = std::fabs(static_cast<double>(exact));
  const double ulp = std::nextafter(nearest, kInfinity) - nearest;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / static_cast<long double>(ulp));
}

using Function = std::function<double(double)>;
using Exact = std::function<long double(long double)>;

double largest_error(double from, double to, const Function& ours, const Exact& exact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(from, to);
  double largest = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double x = uniform(random);
    largest = std::max(largest, error_ulp(ours(x), exact(static_cast<long double>(x))));
  }
  return largest;
}

// Every multiple of pi/4 up to about 1e6, and its neighbours: where sin, cos and tan lose most in the reduction.
double largest_error_at_quarters(const Function& ours, const Exact& exact) {
  double largest = 0.0;
  for (int i = 1; i < 1270000; i += 13) {
    const double x = static_cast<double>(std::numbers::pi_v<long double> / 4 * i);
    for (const double near : {std::nextafter(x, 0.0), x, std::nextafter(x, kInfinity)})
      largest = std::max(largest, error_ulp(ours(near), exact(static_cast<long double>(near))));
  }
  return largest;
}

long double sinl_(long double x) { return std::sin(x); }
long double cosl_(long double x) { return std::cos(x); }
long double tanl_(long double x) { return std::tan(x); }

}  // namespace

TEST(Mathematics, SineAndCosineWithin0p8Ulp) {
  for (const double range : {1e-9, 0.9, 10.0, 1e3, 1e6}) {
    EXPECT_LT(largest_error(-range, range, m::sin, sinl_), 0.8) << range;
    EXPECT_LT(largest_error(-range, range, m::cos, cosl_), 0.8) << range;
  }
  EXPECT_LT(largest_error_at_quarters(m::sin, sinl_), 0.8);
  EXPECT_LT(largest_error_at_quarters(m::cos, cosl_), 0.8);
}

TEST(Mathematics, TangentWithin2p5Ulp) {
  for (const double range : {1e-9, 0.9, 10.0, 1e6})
    EXPECT_LT(largest_error(-range, range, m::tan, tanl_), 2.5) << range;
  EXPECT_LT(largest_error_at_quarters(m::tan, tanl_), 2.5);
}

TEST(Mathematics, DegreesAgreeAndAreExactAtQuarterTurns) {
  constexpr long double kDegree = std::numbers::pi_v<long double> / 180;
  EXPECT_LT(largest_error(-45, 45, m::sin_deg, [](long double d) { return std::sin(d * kDegree); }), 0.8);
  EXPECT_LT(largest_error(-45, 45, m::cos_deg, [](long double d) { return std::cos(d * kDegree); }), 0.8);
  EXPECT_LT(largest_error(-45, 45, m::tan_deg, [](long double d) { return std::tan(d * kDegree); }), 2.5);
  const double sines[4] = {0, 1, 0, -1};
  for (int quarter = -4000; quarter <= 4000; ++quarter) {
    const int phase = ((quarter % 4) + 4) % 4;
    EXPECT_EQ(m::sin_deg(90.0 * quarter), sines[phase]);
    EXPECT_EQ(m::cos_deg(90.0 * quarter), sines[(phase + 1) % 4]);
  }
  for (int degree = 0; degree < 360; ++degree) {
    EXPECT_EQ(m::sin_deg(degree + 360e6), m::sin_deg(degree)) << degree;
    EXPECT_EQ(m::cos_deg(degree - 360e6), m::cos_deg(degree)) << degree;
    EXPECT_EQ(m::sin_deg(-degree), 0.0 - m::sin_deg(degree)) << degree;
  }
  EXPECT_TRUE(std::isnan(m::sin_deg(kInfinity)));
  EXPECT_TRUE(std::isnan(m::cos_deg(kNan)));
}

TEST(Mathematics, RadiansAreRoundedOnce) {
  EXPECT_EQ(m::radians(180), m::kPi);
  EXPECT_EQ(m::radians(90), m::kPi / 2);
  EXPECT_EQ(m::radians(-45), -m::kPi / 4);
  EXPECT_LT(
      largest_error(-1e4, 1e4, m::radians, [](long double d) { return d * std::numbers::pi_v<long double> / 180; }),
      0.5001);
}

TEST(Mathematics, ExponentialWithin1Ulp) {
  for (const double range : {1e-6, 0.4, 10.0, 700.0})
    EXPECT_LT(largest_error(-range, range, m::exp, [](long double x) { return std::exp(x); }), 1.0) << range;
  EXPECT_EQ(m::exp(0.0), 1.0);
  EXPECT_EQ(m::exp(kInfinity), kInfinity);
  EXPECT_EQ(m::exp(-kInfinity), 0.0);
  EXPECT_EQ(m::exp(709.79), kInfinity);
  EXPECT_LT(m::exp(709.78), kInfinity);
  EXPECT_EQ(m::exp(-746.0), 0.0);
  EXPECT_NEAR(m::exp(-740.0) / 0x1p-1074, static_cast<double>(std::exp(-740.0L) / 0x1p-1074L), 0.51);  // subnormal
  EXPECT_TRUE(std::isnan(m::exp(kNan)));
}

TEST(Mathematics, LogarithmWithin1Ulp) {
  const auto exact = [](long double x) { return std::log(x); };
  EXPECT_LT(largest_error(0.999, 1.001, m::log, exact), 1.0);
  EXPECT_LT(largest_error(0.5, 2.0, m::log, exact), 1.0);
  EXPECT_LT(largest_error(0.0, 1e9, m::log, exact), 1.0);
  EXPECT_LT(largest_error(1e-310, 1e-307, m::log, exact), 1.0);  // subnormal arguments
  EXPECT_EQ(m::log(1.0), 0.0);
  EXPECT_EQ(m::log(0.0), -kInfinity);
  EXPECT_EQ(m::log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(m::log(-1.0)));
}

TEST(Mathematics, PowerWithin1Ulp) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> base(1e-3, 40.0);
  std::uniform_real_distribution<double> exponent(-190.0, 190.0);
  double largest = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = base(random);
    const double y = i % 2 == 0 ? exponent(random) : std::floor(exponent(random));
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
    if (exact < 1e-300L || exact > 1e300L) continue;
    largest = std::max(largest, error_ulp(m::pow(x, y), exact));
  }
  EXPECT_LT(largest, 1.0);
}

TEST(Mathematics, SmallIntegerPowersAreExact) {
  for (int x = 1; x <= 20; ++x) {
    double product = 1.0;
    for (int n = 0; n <= 12; ++n, product *= x) {
      EXPECT_EQ(m::pow(x, n), product) << x << '^' << n;
      EXPECT_EQ(m::pow(-x, n), n % 2 == 0 ? product : -product) << x << '^' << n;
    }
  }
}

TEST(Mathematics, PowerHasTheSpecialCasesOfTheStandard) {
  const std::vector<double> values{0.0, -0.0, 1.0, -1.0,      2.0,        -2.0, 3.0,  -3.0,
                                   0.5, -0.5, 2.5, kInfinity, -kInfinity, kNan, 1e30, 1e300};
  for (const double x : values)
    for (const double y : values) {
      const double expected = std::pow(x, y);
      const double actual = m::pow(x, y);
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(actual)) << x << '^' << y;
      } else if (expected == 0.0 || std::isinf(expected)) {
        EXPECT_EQ(actual, expected) << x << '^' << y;
        EXPECT_EQ(std::signbit(actual), std::signbit(expected)) << x << '^' << y;
      } else {
        EXPECT_LT(error_ulp(actual, static_cast<long double>(expected)), 1.5) << x << '^' << y;
      }
    }
}

TEST(Mathematics, ArcCosineWithin2Ulp) {
  const auto exact = [](long double x) { return std::acos(x); };
  EXPECT_LT(largest_error(-1.0, 1.0, m::acos, exact), 2.0);
  EXPECT_LT(largest_error(0.999999, 1.0, m::acos, exact), 2.0);
  EXPECT_LT(largest_error(-1.0, -0.999999, m::acos, exact), 2.0);
  EXPECT_EQ(m::acos(1.0), 0.0);
  EXPECT_EQ(m::acos(-1.0), m::kPi);
  EXPECT_EQ(m::acos(0.0), m::kPi / 2);
  EXPECT_TRUE(std::isnan(m::acos(1.0000001)));
}

TEST(Mathematics, ArcTangentWithin1p1Ulp) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double scale : {1.0, 1e-6, 1e250, 1e-250, 1e300}) {
    double largest = 0.0;
    for (int i = 0; i < 50000; ++i) {
      const double y = uniform(random) * scale;
      const double x = uniform(random) * scale;
      largest = std::max(
          largest, error_ulp(m::atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    }
    EXPECT_LT(largest, 1.1) << scale;
  }
}

TEST(Mathematics, ArcTangentHasTheSpecialCasesOfTheStandard) {
  const std::vector<double> values{0.0, -0.0, 1.0, -1.0, kInfinity, -kInfinity, 1e-320, kNan, 1e300};
  for (const double y : values)
    for (const double x : values) {
      const double expected = std::atan2(y, x);
      const double actual = m::atan2(y, x);
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(actual));
        continue;
      }
      EXPECT_DOUBLE_EQ(actual, expected) << y << ' ' << x;
      EXPECT_EQ(std::signbit(actual), std::signbit(expected)) << y << ' ' << x;
    }
}

TEST(Mathematics, WhatCannotBeReducedIsNotANumber) {
  for (const double x : {kInfinity, -kInfinity, kNan, 1e10}) {
    EXPECT_TRUE(std::isnan(m::sin(x)));
    EXPECT_TRUE(std::isnan(m::cos(x)));
    EXPECT_TRUE(std::isnan(m::tan(x)));
  }
}
