// Does work cost what the T800-20's data say: 1.5 Mflop/s sustained, 1.74 MB/s a link, three cycles a bus word?
#include "modules/host/cost_model.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace rastertlm::host {
namespace {

geometry::OperationCounts flops(std::uint64_t count) {
  geometry::OperationCounts counts;
  counts.multiply = count;
  return counts;
}

TEST(HostCost, T800) {
  const HostCost cost{HostParameters{}};
  EXPECT_DOUBLE_EQ(cost.clock().period_ns(), 50.0);
  EXPECT_NEAR(cost.cycles_per_flop(), 13.33, 0.005);
  EXPECT_EQ(cost.compute(flops(0)), Cycles(0));
  EXPECT_EQ(cost.compute(flops(1)), Cycles(14));            // a piece of work is rounded up
  EXPECT_EQ(cost.compute(flops(3)), Cycles(40));            // not every operation
  EXPECT_EQ(cost.compute(flops(30'000)), Cycles(400'000));  // a frame of 20 ms
  EXPECT_EQ(cost.bus(22), Cycles(66));
  EXPECT_EQ(cost.bus(0), Cycles(0));
}

// Integer work is part of what a sustained rate already pays for.
TEST(HostCost, CountsEveryFloatingPointOperationAsOne) {
  const HostCost cost{HostParameters{}};
  geometry::OperationCounts counts;
  counts.add = counts.multiply = counts.divide = counts.square_root = counts.compare = counts.convert = 1;
  EXPECT_EQ(cost.compute(counts), Cycles(80));
  counts.integer = counts.integer_multiply = 1000;
  EXPECT_EQ(cost.compute(counts), Cycles(80));
}

// 11 bits and half an acknowledge's wait: 11.5 cycles of 20 MHz a byte at 20 Mbit/s; 19 cycles to start.
TEST(HostCost, MessagesOfATransputerLink) {
  const HostCost cost{HostParameters{}};
  EXPECT_EQ(cost.message(0), Cycles(19));
  EXPECT_EQ(cost.message(1), Cycles(19 + 12));
  EXPECT_EQ(cost.message(2), Cycles(19 + 23));
  EXPECT_EQ(cost.message(72), Cycles(19 + 828));
  // 1.74 MB/s for long messages, within a thousandth.
  const std::uint64_t bytes = 10'000'000;
  EXPECT_NEAR(static_cast<double>(bytes) / cost.clock().seconds(cost.message(bytes)), 1.74e6, 1.74e3);
}

// The link has a clock of its own: at 30 MHz its bytes take half as many cycles more, its start the same.
TEST(HostCost, ThirtyMegahertz) {
  HostParameters parameters;
  parameters.clock_hz = 30'000'000;
  parameters.sustained_mflops = 2.25;
  const HostCost cost{parameters};
  EXPECT_NEAR(cost.cycles_per_flop(), 13.33, 0.005);
  EXPECT_EQ(cost.message(4), Cycles(19 + 69));
  EXPECT_EQ(cost.message(5), Cycles(19 + 87));  // 86.25
  EXPECT_EQ(cost.compute(flops(45'000)), Cycles(600'000));
}

// The least whole number of cycles that is not less than flops x clock / rate, in integers.
RC_GTEST_PROP(HostCost, RoundsUpOnce, ()) {
  HostParameters parameters;
  parameters.clock_hz = *rc::gen::inRange<std::int64_t>(1, 1000) * 1'000'000;
  const auto rate = *rc::gen::inRange<std::uint64_t>(1, 500);
  parameters.sustained_mflops = static_cast<double>(rate);
  const HostCost cost{parameters};
  const auto count = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  const auto megahertz = static_cast<std::uint64_t>(parameters.clock_hz / 1'000'000);
  RC_ASSERT(cost.compute(flops(count)) == Cycles((count * megahertz + rate - 1) / rate));
}

}  // namespace
}  // namespace rastertlm::host
