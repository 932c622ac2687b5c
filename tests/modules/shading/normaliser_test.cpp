// Does the normaliser give unit vectors, at any width, and does it count what it cannot normalise?
#include "modules/shading/normaliser.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace rastertlm::shading {
namespace {

TEST(Normaliser, StaysWithinItsErrorBudgetAtEveryWidth) {
  EXPECT_TRUE(rc::check([] {
    ShadingParameters p;
    p.arithmetic = *rc::gen::element(Arithmetic::literal, Arithmetic::centred);
    const auto normal_bits = *rc::gen::inRange<std::int64_t>(6, 17);
    p.normaliser_address_bits = *rc::gen::inRange<std::int64_t>(8, std::min<std::int64_t>(2 * normal_bits, 20) + 1);
    p.dot_table_address_bits = *rc::gen::inRange<std::int64_t>(4, 16);
    p.normaliser_output_bits =
        *rc::gen::inRange<std::int64_t>(std::max<std::int64_t>(8, p.dot_table_address_bits + 2 - normal_bits), 17);
    const Normaliser normaliser(p, normal_bits);
    const std::uint32_t sign = 1U << (normal_bits - 1);
    const std::uint32_t half = sign / 2;
    // The pre-normalisation unit leaves the largest component's top bit set.
    std::array<std::uint32_t, 3> m{*rc::gen::inRange(half, sign), *rc::gen::inRange(0U, sign),
                                   *rc::gen::inRange(0U, sign)};
    std::array<bool, 3> negative{*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()};
    const auto out = normaliser.normalise(m[0] | (negative[0] ? sign : 0), m[1] | (negative[1] ? sign : 0),
                                          m[2] | (negative[2] ? sign : 0));
    RC_ASSERT(out.negative == negative);
    RC_ASSERT(!out.is_zero);
    RC_ASSERT(!out.is_short);
    double length = 0;
    for (const auto c : m) length += (c + 0.5) * (c + 0.5);
    length = std::sqrt(length);
    const double scale = std::ldexp(1.0, int(p.dot_table_address_bits));
    // Half an interval of the ROM's address, half a unit of its word (one where it is clamped), what a word's
    // truncation turns the length by.
    const double squares = std::ldexp(1.0, int(2 * normal_bits - 4));
    const double address = std::ldexp(1.0, int(2 * normal_bits - p.normaliser_address_bits));
    const double root = std::ldexp(1.0, int(p.normaliser_output_bits + normal_bits - 2)) / length;
    const double relative = std::pow(1.0 - std::min(0.5, address / squares), -0.5) - 1.0 + 1.5 / root + 3.0 / length;
    for (std::size_t i = 0; i < 3; ++i) {
      const double exact = scale * (m[i] + 0.5) / length;
      const double truncated = p.arithmetic == Arithmetic::literal ? 0.5 * scale / length : 0.0;
      RC_ASSERT(out.magnitude[i] < scale);
      RC_ASSERT(std::abs(out.magnitude[i] - exact) <= 1.0 + exact * relative + truncated);
    }
  }));
}

TEST(Normaliser, ReadsTheDocumentedEntries) {
  ShadingParameters p;
  p.normaliser_address_bits = 12;
  const Normaliser normaliser(p, 12);
  ASSERT_EQ(normaliser.rom().size(), 4096U);
  EXPECT_EQ(normaliser.rom()[0], 4095);     // clamped
  EXPECT_EQ(normaliser.rom()[256], 4092);   // 2^22 / sqrt(256.5 x 4096) = 4092.0
  EXPECT_EQ(normaliser.rom()[1024], 2048);  // 2^22 / sqrt(1024.5 x 4096) = 2047.5
  EXPECT_EQ(normaliser.rom()[3071], 1183);  // 2^22 / sqrt(3071.5 x 4096) = 1182.51
}

TEST(Normaliser, CountsShortAndZeroNormals) {
  for (const Arithmetic arithmetic : {Arithmetic::literal, Arithmetic::centred}) {
    ShadingParameters p;
    p.arithmetic = arithmetic;
    const Normaliser normaliser(p, 12);
    EXPECT_FALSE(normaliser.normalise(0, 0, 1024).is_short);
    EXPECT_TRUE(normaliser.normalise(0, 0, 1022).is_short);
    EXPECT_LT(normaliser.normalise(0, 0, 512).magnitude[2], 1100U);  // darker: half of full scale
    const auto zero = normaliser.normalise(0, 2048, 0);              // a zero with its sign bit set
    EXPECT_TRUE(zero.is_zero);
    EXPECT_FALSE(zero.is_short);
  }
}

}  // namespace
}  // namespace rastertlm::shading
