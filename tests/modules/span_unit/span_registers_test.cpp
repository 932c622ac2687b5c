// Do the registers of figure 6 go through the values that figure 7 prints, and is their error what the proof allows?
#include "modules/span_unit/span_registers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "modules/span_unit/parameters.h"
#include "src/base/fixed_point.h"
#include "tests/support/figure_7.h"

namespace rastertlm::span_unit {
namespace {

TEST(SpanRegisters, GoThroughFigure7) {
  const std::vector<test::Figure7Row> rows = test::figure_7();
  ASSERT_EQ(rows.size(), 10U);
  ColourRegisters registers(32);
  for (const test::Figure7Row& row : rows) {
    if (row.clock == 1)
      registers.load(test::kFigure7);
    else if (row.load_line)
      registers.step_line(false);
    else
      registers.step_pixel();
    EXPECT_EQ(registers.i(), row.i) << "clock " << row.clock;
    EXPECT_EQ(registers.di(), row.di) << "clock " << row.clock;
    EXPECT_EQ(registers.start(), row.start) << "clock " << row.clock;
    EXPECT_EQ(registers.line_step(), row.line_step) << "clock " << row.clock;
    EXPECT_EQ(registers.pixel_step(), row.pixel_step) << "clock " << row.clock;
  }
}

TEST(SpanRegisters, LevelsAreClampedOnlyAtTheOutput) {
  EXPECT_EQ(level_of(0x06AFFFF8, 32, 20), 106U);
  EXPECT_EQ(level_of(std::uint64_t{300} << 20, 32, 20), 255U);
  EXPECT_EQ(level_of(0xFFF00000, 32, 20), 0U);  // -1
  EXPECT_EQ(level_of(std::uint64_t{255} << 8, 18, 8), 255U);
  EXPECT_EQ(level_of((std::uint64_t{1} << 18) - 1, 18, 8), 0U);
}

// A path of line steps, then pixel steps, on exact constants and on rounded ones: their difference in steps of the last
// bit, times 2. Constants are given in 1/64 of the last bit.
struct Path {
  std::int64_t start, line_step, pixel_step, line_line, line_pixel, pixel_pixel;
};
double error_at(const Path& exact, std::int64_t lines, std::int64_t pixels) {
  constexpr std::int64_t kPart = 64;
  const auto word = [](std::int64_t parts) { return static_cast<std::uint64_t>(floor_div(parts + kPart / 2, kPart)); };
  ColourRegisters registers(64);
  registers.load({word(exact.start), word(exact.line_step), word(exact.pixel_step), word(exact.line_line),
                  word(exact.line_pixel), word(exact.pixel_pixel)});
  for (std::int64_t k = 0; k < lines; ++k) registers.step_line(false);
  for (std::int64_t k = 0; k < pixels; ++k) registers.step_pixel();
  const std::int64_t value = exact.start + lines * exact.line_step + lines * (lines - 1) / 2 * exact.line_line +
                             pixels * (exact.pixel_step + lines * exact.line_pixel) +
                             pixels * (pixels - 1) / 2 * exact.pixel_pixel;
  const auto shown = static_cast<std::int64_t>(registers.i());
  return std::fabs(static_cast<double>(shown * kPart - value)) / kPart;
}

// The bound in steps of the last bit: (k^2 + k + 2) / 4.
double bound_at(std::int64_t k) { return fraction_bound(0, static_cast<std::uint64_t>(k)); }

TEST(SpanRegisters, ErrorStaysBelowTheProvedBound) {
  std::mt19937_64 random(3);
  for (const std::int64_t steps : {64, 128, 256, 512, 1024, 2048})
    for (int round = 0; round < 200; ++round) {
      const auto part = [&] { return static_cast<std::int64_t>(random() % 200000) - 100000; };
      const std::int64_t lines = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(steps));
      const double error = error_at({part(), part(), part(), part(), part(), part()}, lines, steps - lines);
      ASSERT_LE(error, bound_at(steps));
    }
}

// Every constant half a bit off, all the same way (63/64 of it, to be rounded that way): the bound, but for the 1/64.
TEST(SpanRegisters, AdversarialConstantsReachTheBound) {
  constexpr std::int64_t kAlmostHalf = 31;  // of 64
  for (const std::int64_t steps : {64, 1024, 2048}) {
    const double error = error_at({kAlmostHalf, kAlmostHalf, kAlmostHalf, kAlmostHalf, kAlmostHalf, kAlmostHalf},
                                  steps / 2, steps - steps / 2);
    EXPECT_LE(error, bound_at(steps));
    EXPECT_GT(error, bound_at(steps) * kAlmostHalf / 32 * 0.999999);
  }
}

// 000/001 asks for more bits than log2 of the steps; the bound asks for twice as many.
TEST(SpanRegisters, BitsThatAScreenNeeds) {
  EXPECT_NEAR(fraction_bound(20, 1024), 0.25, 0.001);
  EXPECT_NEAR(fraction_bound(20, 2048), 1.0005, 0.0001);
  EXPECT_NEAR(fraction_bound(11, 1024), 128.0, 0.2);
  const double needed[][2] = {{64, 12}, {128, 14}, {256, 16}, {512, 18}, {1024, 20}, {2048, 22}};
  for (const auto& [steps, bits] : needed) {
    EXPECT_LT(fraction_bound(static_cast<std::int64_t>(bits), static_cast<std::uint64_t>(steps)), 0.5);
    EXPECT_GE(fraction_bound(static_cast<std::int64_t>(bits) - 1, static_cast<std::uint64_t>(steps)), 0.5);
  }
}

}  // namespace
}  // namespace rastertlm::span_unit
