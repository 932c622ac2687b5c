#include "src/base/units.h"

#include <gtest/gtest.h>

namespace rastertlm {
namespace {

TEST(Cycles, AddAndCompare) {
  Cycles c(5);
  c += Cycles(7);
  EXPECT_EQ(c, Cycles(12));
  EXPECT_EQ(c - Cycles(2), Cycles(10));
  EXPECT_EQ(Cycles(3) * 4, c);
  EXPECT_LT(Cycles(3), Cycles(4));
}

// 3 MHz has a period that no number of picoseconds is: cycles are counted and converted once, so nothing is lost on the
// way.
TEST(Clock, RationalPeriodsDoNotDrift) {
  const Clock clock = Clock::from_frequency_hz("odd", 3'000'000);
  EXPECT_EQ(clock.picoseconds(Cycles(1)), 333'333U);
  EXPECT_EQ(clock.picoseconds(Cycles(2)), 666'667U);
  EXPECT_EQ(clock.picoseconds(Cycles(3'000'000)), 1'000'000'000'000U);
  EXPECT_EQ(clock.picoseconds(Cycles(3'000'000'000'000)), 1'000'000'000'000'000'000U);
  EXPECT_DOUBLE_EQ(clock.frequency_hz(), 3e6);
}

TEST(Clock, PixelClockOfThePaper) {
  const Clock clock = Clock::from_period_ns("pixel", 60.0);
  EXPECT_EQ(clock.picoseconds(Cycles(512)), 30'720'000U);
  EXPECT_DOUBLE_EQ(clock.period_ns(), 60.0);
  EXPECT_EQ(clock.cycles_round(600e-6), Cycles(10'000));
  EXPECT_EQ(clock.cycles_round(1.0 / 50), Cycles(333'333));
  EXPECT_EQ(clock.name(), "pixel");
}

TEST(Clock, FindsTheCycleThatStartsAtOrAfter) {
  const Clock clock = Clock::from_period_ns("pixel", 60.0);
  EXPECT_EQ(clock.cycles_at(0), Cycles(0));
  EXPECT_EQ(clock.cycles_at(1), Cycles(1));
  EXPECT_EQ(clock.cycles_at(60'000), Cycles(1));
  EXPECT_EQ(clock.cycles_at(60'001), Cycles(2));
}

TEST(Clock, PeriodsAreTakenToTheFemtosecond) {
  EXPECT_DOUBLE_EQ(Clock::from_period_ns("vga", 39.7219).period_ns(), 39.7219);
  EXPECT_EQ(Clock::from_period_ns("vga", 39.7219).picoseconds(Cycles(10)), 397'219U);
}

}  // namespace
}  // namespace rastertlm
