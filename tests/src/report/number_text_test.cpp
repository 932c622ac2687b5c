#include "src/report/number_text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

namespace rastertlm::report {
namespace {

TEST(NumberText, RoundsToSignificantDigits) {
  EXPECT_EQ(to_significant(0.123456789, 6), 0.123457);
  EXPECT_EQ(to_significant(-1234567.0, 6), -1234570.0);
  EXPECT_EQ(to_significant(9.999996e-300, 6), 1e-299);
  EXPECT_EQ(to_significant(0.0, 6), 0.0);
  EXPECT_TRUE(std::isinf(to_significant(std::numeric_limits<double>::infinity(), 6)));
}

TEST(NumberText, RoundingAgainChangesNothingAndIsNear) {
  EXPECT_TRUE(rc::check("to_significant", [](double value) {
    RC_PRE(std::isfinite(value) && (value == 0.0 || (std::abs(value) > 1e-290 && std::abs(value) < 1e290)));
    const double rounded = to_significant(value, 6);
    RC_ASSERT(to_significant(rounded, 6) == rounded);
    // Half a unit of the sixth digit is at most 5e-6 of the value.
    RC_ASSERT(std::abs(rounded - value) <= 5.0000001e-6 * std::abs(value));
  }));
}

TEST(NumberText, KeepsIntegersThatADoubleHolds) {
  EXPECT_EQ(to_stored(9007199254740991.0), 9007199254740991.0);
  EXPECT_EQ(to_stored(1e9 / 60.0), 16666666.7);
}

TEST(NumberText, PrintsQuantitiesWithTheirUnits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(18'446'744'073'709'551'615U), "18,446,744,073,709,551,615");
  EXPECT_EQ(quantity(333'333.0), "333,333");
  EXPECT_EQ(quantity(-2.0), "-2");
  EXPECT_EQ(quantity(0.12345), "0.1235");
  EXPECT_EQ(quantity(12'345.6), "12,346");
  EXPECT_EQ(quantity(999.96), "1,000");
  EXPECT_EQ(quantity(-1234.5), "-1,235");
  EXPECT_EQ(quantity(std::numeric_limits<double>::infinity()), "unlimited");
  EXPECT_EQ(percent(0.8376), "84 %");
  EXPECT_EQ(percent(0.00416), "0.42 %");
  EXPECT_EQ(percent(24.0), "2,400 %");
  EXPECT_EQ(frequency(1e9 / 60.0), "16.67 MHz");
  EXPECT_EQ(bytes_per_second(800.0), "800 B/s");
  EXPECT_EQ(bits(1024), "1,024 bits");
  EXPECT_EQ(bits(16 * 4096 * 8), "512 Kibit");
  EXPECT_EQ(bits(8U << 20U), "8 Mibit");
  EXPECT_EQ(counted(1, "frame", "frames"), "1 frame");
  EXPECT_EQ(counted(0, "frame", "frames"), "0 frames");
}

}  // namespace
}  // namespace rastertlm::report
