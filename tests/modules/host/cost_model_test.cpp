// Does work cost what the T800-20's data say: 1.5 Mflop/s sustained, 1.74 MB/s a link, three cycles a bus word?
#include "modules/host/cost_model.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <vector>

namespace rastertlm::host {
namespace {

geometry::OperationCounts flops(std::uint64_t count) {
  geometry::OperationCounts counts;
  counts.multiply = count;
  return counts;
}

// Its start, and its way.
Cycles message(const HostCost& cost, std::uint64_t bytes) { return cost.link_set_up() + cost.transfer(bytes); }

TEST(HostCost, T800) {
  const HostCost cost{HostParameters{}};
  EXPECT_DOUBLE_EQ(cost.clock().period_ns(), 50.0);
  EXPECT_NEAR(cost.cycles_per_flop(flops(1)), 13.33, 0.005);
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
  EXPECT_EQ(message(cost, 0), Cycles(19));
  EXPECT_EQ(message(cost, 1), Cycles(19 + 12));
  EXPECT_EQ(message(cost, 2), Cycles(19 + 23));
  EXPECT_EQ(message(cost, 72), Cycles(19 + 828));
  // 1.74 MB/s for long messages, within a thousandth.
  const std::uint64_t bytes = 10'000'000;
  EXPECT_NEAR(static_cast<double>(bytes) / cost.clock().seconds(message(cost, bytes)), 1.74e6, 1.74e3);
}

// The link has a clock of its own: at 30 MHz its bytes take half as many cycles more, its start the same.
TEST(HostCost, ThirtyMegahertz) {
  HostParameters parameters;
  parameters.clock_hz = 30'000'000;
  parameters.sustained_mflops = 2.25;
  const HostCost cost{parameters};
  EXPECT_NEAR(cost.cycles_per_flop(flops(1)), 13.33, 0.005);
  EXPECT_EQ(message(cost, 4), Cycles(19 + 69));
  EXPECT_EQ(message(cost, 5), Cycles(19 + 87));  // 86.25
  EXPECT_EQ(cost.compute(flops(45'000)), Cycles(600'000));
}

// By the table each operation has its own cost, and what brings its operand, whatever the sustained rate.
TEST(HostCost, ByInstructions) {
  HostParameters parameters;
  parameters.cost = CostModel::instructions;
  parameters.sustained_mflops = 1e6;
  const HostCost cost{parameters};
  // fpadd 6 + 1 of its prefix; with ldl 2, fpldnlsn 2 and a prefix for the operand.
  geometry::OperationCounts counts;
  counts.add = 10;
  EXPECT_EQ(cost.compute(counts), Cycles(10 * (7 + 5)));
  counts.multiply = 10;
  EXPECT_EQ(cost.compute(counts), Cycles(10 * (7 + 5) + 10 * (12 + 5)));
  EXPECT_NEAR(cost.cycles_per_flop(counts), 14.5, 1e-9);
  counts.square_root = 1;  // first 27, two steps of 42, last 8, four prefixes; one operand, which stands on the stack
  counts.divide = 1;
  counts.convert = 1;
  counts.compare = 1;
  EXPECT_EQ(cost.compute(counts), Cycles(290 + 123 + (17 + 5) + 9 + (5 + 5)));
  const Cycles before = cost.compute(counts);
  counts.integer = 7;
  counts.integer_multiply = 2;
  EXPECT_EQ(cost.compute(counts), before + Cycles(7 + 80));
  EXPECT_EQ(cost.compute({}), Cycles(0));
}

// A coefficient that is wider than the bus takes several words.
TEST(HostCost, WordsOfANarrowBus) {
  HostParameters parameters;
  parameters.bus_cycles_per_word = 3;
  const std::vector<std::array<std::int64_t, 3>> widths{{8, 24, 3},  {16, 24, 2}, {16, 16, 1}, {24, 24, 1},
                                                        {32, 32, 1}, {8, 25, 4},  {64, 32, 1}};
  for (const auto& [bus, coefficient, words] : widths) {
    parameters.bus_bits = bus;
    const HostCost cost{parameters, coefficient};
    EXPECT_EQ(cost.bus_words(22), 22 * static_cast<std::uint64_t>(words)) << bus << ' ' << coefficient;
    EXPECT_EQ(cost.bus(22), Cycles(66 * static_cast<std::uint64_t>(words)));
  }
}

// Links that send packets: 10 bits a byte, and 34 bits a packet of up to 32 bytes, five bits a cycle.
TEST(HostCost, PacketsHaveBitsOfTheirOwn) {
  HostParameters parameters;
  parameters.link_mbit_per_s = 100.0;
  parameters.link_bits_per_byte = 10.0;
  parameters.link_packet_bytes = 32;
  parameters.link_packet_bits = 34.0;
  const HostCost cost{parameters};
  EXPECT_EQ(cost.transfer(0), Cycles(0));
  EXPECT_EQ(cost.transfer(1), Cycles(9));     // 44 bits
  EXPECT_EQ(cost.transfer(32), Cycles(71));   // 354
  EXPECT_EQ(cost.transfer(33), Cycles(80));   // 398
  EXPECT_EQ(cost.transfer(64), Cycles(142));  // 708
  // About 9 MB/s of the 10 that bytes alone would have.
  EXPECT_NEAR(100.0 / cost.link_bits_per_byte(), 9.04, 0.01);
  EXPECT_EQ(cost.link_cycles(32), Cycles(32));
  EXPECT_EQ(cost.link_cycles(1), Cycles(4));  // 44 bits at 11.06 a byte
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
