// Words of hardware, against remainders in 128 bits.
#include "src/base/fixed_point.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace rastertlm {
namespace {

__extension__ using Wide = __int128;

Wide power(unsigned bits) { return Wide{1} << bits; }

RC_GTEST_PROP(FixedPoint, WrapUnsignedIsTheRemainder, (std::int64_t value)) {
  const auto bits = *rc::gen::inRange(1U, 65U);
  const Wide remainder = ((Wide{value} % power(bits)) + power(bits)) % power(bits);
  RC_ASSERT(Wide{wrap_unsigned(value, bits)} == remainder);
}

RC_GTEST_PROP(FixedPoint, WrapSignedDiffersByWholeTurnsAndIsInRange, (std::int64_t value)) {
  const auto bits = *rc::gen::inRange(1U, 65U);
  const Wide wrapped = wrap_signed(value, bits);
  RC_ASSERT((Wide{value} - wrapped) % power(bits) == 0);
  RC_ASSERT(wrapped >= -power(bits - 1));
  RC_ASSERT(wrapped < power(bits - 1));
}

RC_GTEST_PROP(FixedPoint, DivisionsRoundTheirOwnWay, (std::int64_t value)) {
  const auto divisor = *rc::gen::inRange<std::int64_t>(1, 1'000'000);
  RC_PRE(value > std::numeric_limits<std::int64_t>::min());
  const Wide down = floor_div(value, divisor);
  const Wide up = ceil_div(value, divisor);
  RC_ASSERT(down * divisor <= value);
  RC_ASSERT((down + 1) * divisor > value);
  RC_ASSERT(up * divisor >= value);
  RC_ASSERT((up - 1) * divisor < value);
}

TEST(FixedPoint, RoundsHalvesUpwards) {
  EXPECT_EQ(round_half_up(0.5), 1);
  EXPECT_EQ(round_half_up(-0.5), 0);
  EXPECT_EQ(round_half_up(-1.5), -1);
  EXPECT_EQ(round_half_up(2.4), 2);
  EXPECT_EQ(round_half_up(-2.6), -3);
}

TEST(FixedPoint, CountsBits) {
  EXPECT_EQ(bit_length(0), 0U);
  EXPECT_EQ(bit_length(1), 1U);
  EXPECT_EQ(bit_length(255), 8U);
  EXPECT_EQ(bit_length(256), 9U);
  EXPECT_EQ(low_mask(0), 0U);
  EXPECT_EQ(low_mask(12), 4095U);
  EXPECT_EQ(low_mask(64), ~std::uint64_t{0});
}

}  // namespace
}  // namespace rastertlm
