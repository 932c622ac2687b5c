// Do the incremental algorithms give what a direct formula would, for every entry?
#include "modules/shading/table_filler.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace rastertlm::shading {
namespace {

template <class Property>
void expect_holds(Property property) {
  EXPECT_TRUE(rc::check(property));
}

std::vector<std::uint32_t> stepped(const Ramp& ramp) {
  std::vector<std::uint32_t> table(ramp.entries, 0xFFFFFFFF);
  for (RampFiller filler(ramp); !filler.done();) {
    const FillStep step = filler.step();
    table.at(step.address) = step.value;
  }
  return table;
}

// Exact rationals, floor of numerator / denominator.
std::uint32_t ratio_floor(std::uint64_t numerator, std::uint64_t denominator) {
  return static_cast<std::uint32_t>(numerator / denominator);
}

TEST(TableFiller, DotProductTables) {
  expect_holds([] {
    const auto bits = *rc::gen::inRange<unsigned>(1, 13);
    const std::uint64_t size = std::uint64_t{1} << bits;
    const auto word = *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(size) + 1);
    const auto literal = stepped(product_ramp(word, bits, Arithmetic::literal));
    const auto centred = stepped(product_ramp(word, bits, Arithmetic::centred));
    RC_ASSERT(literal.size() == size);
    for (std::uint64_t n = 0; n < size; ++n) {
      RC_ASSERT(literal[n] == ratio_floor(n * word, size));
      RC_ASSERT(centred[n] == ratio_floor((2 * n + 1) * word, 2 * size));
      RC_ASSERT(centred[n] < size);
    }
  });
}

TEST(TableFiller, DiffuseTables) {
  expect_holds([] {
    const auto bits = *rc::gen::inRange<unsigned>(3, 13);
    const auto fraction = *rc::gen::inRange<unsigned>(0, 13);
    const std::uint64_t size = std::uint64_t{1} << bits;
    const auto constant = *rc::gen::inRange<std::uint32_t>(0, (255U << fraction) + 1);
    const auto literal = stepped(level_ramp(constant, bits, 0, Arithmetic::literal));
    const auto centred = stepped(level_ramp(constant, bits, fraction, Arithmetic::centred));
    for (std::uint64_t i = 0; i < size; ++i) {
      RC_ASSERT(literal[i] == ratio_floor(i * constant, size));
      // round(c (i + 1/2) / size), c = constant / 2^fraction
      const double exact = std::ldexp(static_cast<double>(constant), -static_cast<int>(fraction)) *
                           (static_cast<double>(i) + 0.5) / static_cast<double>(size);
      RC_ASSERT(centred[i] == static_cast<std::uint32_t>(std::floor(exact + 0.5)));
      RC_ASSERT(centred[i] <= 255U);
    }
  });
}

TEST(TableFiller, SpecularTables) {
  expect_holds([] {
    const auto arithmetic = *rc::gen::element(Arithmetic::literal, Arithmetic::centred);
    const auto inputs = *rc::gen::inRange<unsigned>(3, 11);
    const auto outputs = *rc::gen::inRange<unsigned>(2, 9);
    const auto exponent = *rc::gen::inRange<std::int64_t>(1, 201);
    const std::uint32_t top = (1U << outputs) - 1;
    const auto ks = *rc::gen::inRange<std::uint32_t>(0, top + (arithmetic == Arithmetic::literal ? 1U : 2U));
    const auto states = power_states(exponent, inputs, outputs, arithmetic);
    const auto moves = path_of(states, outputs);
    std::vector<std::uint8_t> fast(states.size());
    fill(moves, path_scale(ks, outputs, arithmetic), std::span(fast));
    std::vector<std::uint32_t> slow(states.size(), 999);
    for (PathFiller filler(moves, path_scale(ks, outputs, arithmetic)); !filler.done();) {
      const FillStep step = filler.step();
      if (step.stores) slow.at(step.address) = step.value;
    }
    const double half = arithmetic == Arithmetic::literal ? 0.0 : 0.5;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double x = arithmetic == Arithmetic::literal ? double(i) / double(states.size() - 1)
                                                         : (double(i) + 0.5) / double(states.size());
      RC_ASSERT(std::abs(states[i] - top * std::pow(x, double(exponent))) <= 0.5 + 1e-9);
      RC_ASSERT(slow[i] == static_cast<std::uint32_t>(std::floor(states[i] * double(ks) / double(top + 1) + half)));
      RC_ASSERT(fast[i] == slow[i]);
    }
  });
}

// The specular table alone: how far it is from the exact power, from an independent program.
TEST(TableFiller, SpecularTableAlone) {
  const auto errors = [](Arithmetic arithmetic, std::int64_t exponent, double ks, double& mean) {
    const double one = arithmetic == Arithmetic::literal ? 255 : 256;
    std::vector<std::uint8_t> table(1024);
    const auto moves = path_of(power_states(exponent, 10, 8, arithmetic), 8);
    fill(moves, path_scale(static_cast<std::uint32_t>(std::floor(ks * one + 0.5)), 8, arithmetic), std::span(table));
    double largest = 0;
    mean = 0;
    for (int i = 0; i < 1024; ++i) {
      const double x = arithmetic == Arithmetic::literal ? i / 1023.0 : (i + 0.5) / 1024.0;
      const double error = table[static_cast<std::size_t>(i)] - 255.0 * ks * std::pow(x, double(exponent));
      largest = std::max(largest, std::abs(error));
      mean += error / 1024.0;
    }
    return largest;
  };
  double mean = 0;
  for (const auto& [exponent, expected] : {std::pair{1, 1.00}, {10, 0.48}, {50, 0.12}, {200, 0.033}}) {
    EXPECT_NEAR(errors(Arithmetic::literal, exponent, 1.0, mean), 1.50, 0.02) << exponent;
    EXPECT_NEAR(-mean, expected, 0.01) << exponent;
  }
  for (const std::int64_t exponent : {1, 5, 10, 50, 200}) {
    EXPECT_LE(errors(Arithmetic::centred, exponent, 1.0, mean), 0.505) << exponent;
    EXPECT_LE(errors(Arithmetic::centred, exponent, 0.4, mean), 0.995) << exponent;
  }
}

}  // namespace
}  // namespace rastertlm::shading
