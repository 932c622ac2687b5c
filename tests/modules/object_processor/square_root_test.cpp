// Is the extractor's root the largest word whose square is not above the radicand?
#include "modules/object_processor/square_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {
namespace {

// By bisection, in integers.
std::uint64_t largest_root(std::uint64_t radicand, unsigned bits) {
  std::uint64_t low = 0, high = low_mask(bits);
  while (low < high) {
    const std::uint64_t middle = low + (high - low + 1) / 2;
    if (middle * middle <= radicand)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

RootFormat floored(unsigned integer_bits, unsigned guard_bits, unsigned fraction_bits) {
  return {integer_bits, guard_bits, fraction_bits, RootReading::floor};
}

TEST(SquareRoot, IsTheLargestWhoseSquareFits) {
  const RootFormat format = floored(8, 0, 0);
  for (std::uint64_t word = 0; word <= format.largest_word(); ++word)
    ASSERT_EQ(square_root(word, format), largest_root(word, 8)) << word;
}

TEST(SquareRoot, OfEveryFormat) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 20'000; ++round) {
    const auto integer_bits = static_cast<unsigned>(1 + random() % 16);
    const auto guard_bits = static_cast<unsigned>(random() % 13);
    const auto fraction_bits = static_cast<unsigned>(random() % 25);
    const RootFormat format = floored(integer_bits, guard_bits, fraction_bits);
    const std::uint64_t word = round % 5 == 0 ? format.largest_word() : random() % (format.largest_word() / 2 + 1) * 2;
    const std::uint64_t radicand = fraction_bits >= 2 * guard_bits ? word >> (fraction_bits - 2 * guard_bits)
                                                                   : word << (2 * guard_bits - fraction_bits);
    ASSERT_EQ(square_root(word, format), largest_root(radicand, format.result_bits()));
  }
}

// Against the real root: at most a unit below it, or half of one on either side. Dropped bits of the radicand cost
// nothing: no square lies between.
TEST(SquareRoot, IsWithinItsUnit) {
  std::mt19937_64 random(6);
  for (const RootReading reading : {RootReading::floor, RootReading::half_unit}) {
    const RootFormat format{9, 6, 16, reading};
    const double unit = std::ldexp(1.0, -6);
    for (int round = 0; round < 20'000; ++round) {
      const std::uint64_t word = random() % (format.largest_word() + 1);
      const double exact = std::sqrt(std::ldexp(static_cast<double>(word), -16));
      const double root =
          std::ldexp(static_cast<double>(square_root(word, format)), -static_cast<int>(format.read_fraction_bits()));
      if (reading == RootReading::floor) {
        ASSERT_LE(root, exact);
        ASSERT_GT(root + unit, exact);
      } else {
        ASSERT_LE(std::fabs(root - exact), unit / 2);
      }
    }
  }
}

TEST(SquareRoot, ThePipelineGivesARootAClockAStageABit) {
  std::mt19937_64 random(7);
  const RootFormat format{9, 6, 12, RootReading::half_unit};
  RootPipeline pipeline(format);
  std::vector<std::uint64_t> words;
  for (std::size_t clock = 0; clock < 200; ++clock) {
    words.push_back(random() % (format.largest_word() + 1));
    const std::uint64_t root = pipeline.clock(words.back());
    if (clock + 1 >= format.stages()) {
      ASSERT_EQ(root, square_root(words[clock + 1 - format.stages()], format));
    }
  }
  EXPECT_EQ(format.stages(), 15U);
}

// 2 stages: after the first 2 bits of the radicand, 1 of the root, 2 of the remainder; after the second 2 and 3.
TEST(SquareRoot, CountsItsRegisters) { EXPECT_EQ(RootPipeline(floored(2, 0, 0)).register_bits(), 5U + 5U); }

TEST(SquareRoot, WordsBeyondTheLargestWrap) {
  const RootFormat format = floored(4, 0, 0);
  EXPECT_EQ(format.largest_word(), 255U);
  EXPECT_EQ(square_root(256 + 49, format), 7U);
}

}  // namespace
}  // namespace rastertlm::object_processor
