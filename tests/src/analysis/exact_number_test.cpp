// Are the numbers that machines are held against exact, and is the error that Traced carries along a bound?
#include "src/analysis/exact_number.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "src/analysis/traced.h"

namespace rastertlm::analysis {
namespace {

double size(Quad value) { return to_double(absolute(value)); }

TEST(ExactNumber, KnownAngles) {
  const Quad root_half = square_root(static_cast<Quad>(0.5));
  EXPECT_LT(size(sine_deg(30) - static_cast<Quad>(0.5)), 1e-32);
  EXPECT_LT(size(cosine_deg(60) - static_cast<Quad>(0.5)), 1e-32);
  EXPECT_LT(size(sine_deg(45) - root_half), 1e-32);
  EXPECT_LT(size(cosine_deg(-135) + root_half), 1e-32);
  EXPECT_EQ(size(sine_deg(360000000)), 0.0);
  EXPECT_EQ(size(cosine_deg(90)), 0.0);
  EXPECT_LT(size(root_half * root_half - static_cast<Quad>(0.5)), 1e-33);
}

RC_GTEST_PROP(ExactNumber, SumsOfAnglesAreRightTo30Digits, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto angle = [&] { return (static_cast<double>(random()) - 2147483648.0) / 1000.0; };
  const Quad a = angle(), b = angle();
  RC_ASSERT(size(sine_deg(a) * sine_deg(a) + cosine_deg(a) * cosine_deg(a) - 1) < 1e-31);
  RC_ASSERT(size(sine_deg(a + b) - sine_deg(a) * cosine_deg(b) - cosine_deg(a) * sine_deg(b)) < 1e-31);
  // Against another library, as far as that goes.
  const Extended radians = std::remainder(static_cast<Extended>(a), 360.0L) * 3.14159265358979323846264338L / 180;
  RC_ASSERT(std::fabs(static_cast<double>(std::sin(radians) - static_cast<Extended>(sine_deg(a)))) < 1e-18);
}

// Any formula of the four operations: the double is no further from the exact value than it says.
RC_GTEST_PROP(Traced, IsNoFurtherOffThanItsBound, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random()) - 2147483648.0, static_cast<int>(random() % 60) - 50);
  };
  std::array<Traced, 4> terms{number(), number(), number(), number()};
  for (int step = 0; step < 12; ++step) {
    const Traced& a = terms[random() % 4];
    const Traced& b = terms[random() % 4];
    const std::array<Traced, 4> results{a + b, a - b, a * b, a / b};
    const Traced result = results[random() % 4];
    if (!std::isfinite(result.value()) || !std::isfinite(result.bound()) || std::fabs(result.value()) < 1e-200)
      continue;
    RC_ASSERT(result.error() <= result.bound());
    terms[random() % 4] = result;
  }
}

TEST(Traced, CancellationIsBounded) {
  const Traced third = Traced(1.0) / Traced(3.0);
  const Traced rest = third * Traced(3.0) - Traced(1.0);
  EXPECT_EQ(rest.value(), 0.0);
  EXPECT_GT(rest.bound(), 1e-17);
  EXPECT_LT(rest.bound(), 1e-15);
  EXPECT_TRUE(std::isinf((Traced(1.0) / rest).bound()));
}

}  // namespace
}  // namespace rastertlm::analysis
