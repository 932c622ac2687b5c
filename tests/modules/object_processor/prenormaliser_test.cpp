// Is a link word the magnitude shifted by the smallest number of places that makes all three fit?
#include "modules/object_processor/prenormaliser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "src/base/fixed_point.h"

namespace rastertlm::object_processor {
namespace {

ObjectProcessorParameters widths(std::int64_t word, std::int64_t normal) {
  ObjectProcessorParameters parameters;
  parameters.word_bits = word;
  parameters.slice_bits = word;
  parameters.normal_bits = normal;
  return parameters;
}

// 2 N + 1, in half units, is odd and never 0: its magnitude is 2 m + 1 for both signs. Halving it K
// times must bring all three below 2^normal_bits.
struct Exact {
  unsigned shift = 0;
  std::array<std::int64_t, 3> magnitude{};
};
Exact exact(const std::array<std::int64_t, 3>& normal, std::int64_t normal_bits) {
  Exact result;
  for (std::size_t i = 0; i < 3; ++i) result.magnitude[i] = (std::abs(2 * normal[i] + 1) - 1) / 2;
  while (std::any_of(result.magnitude.begin(), result.magnitude.end(),
                     [&](std::int64_t m) { return m >= std::int64_t{1} << (normal_bits - 1); })) {
    for (std::int64_t& m : result.magnitude) m /= 2;
    ++result.shift;
  }
  return result;
}

void compare(std::int64_t word_bits, std::int64_t normal_bits, std::mt19937& random, int count) {
  const Prenormaliser unit(widths(word_bits, normal_bits));
  std::array<std::vector<std::uint32_t>, 3> words;
  std::array<std::vector<std::uint16_t>, 3> links;
  std::vector<LinkNormal> expected;
  for (int i = 0; i < count; ++i) {
    std::array<std::int64_t, 3> normal{};
    std::array<std::uint32_t, 3> word{};
    for (std::size_t component = 0; component < 3; ++component) {
      const auto size = static_cast<unsigned>(1 + random() % static_cast<unsigned>(word_bits));
      normal[component] = sign_extend(random(), size);
      if (random() % 50 == 0) normal[component] = -(std::int64_t{1} << (word_bits - 1));
      if (random() % 50 == 0) normal[component] = (std::int64_t{1} << (word_bits - 1)) - 1;
      // Whatever lies above the word is ignored.
      word[component] = static_cast<std::uint32_t>(normal[component]);
      words[component].push_back(word[component]);
      links[component].push_back(0);
    }
    const Exact wanted = exact(normal, normal_bits);
    ASSERT_EQ(unit.shift_of(word), wanted.shift);
    ASSERT_LE(wanted.shift, unit.largest_shift());
    const LinkNormal link = unit(word);
    for (std::size_t component = 0; component < 3; ++component) {
      const std::int64_t sign = normal[component] < 0 ? -1 : 1;
      ASSERT_EQ(half_units(link[component], static_cast<unsigned>(normal_bits)),
                sign * (2 * wanted.magnitude[component] + 1));
      ASSERT_EQ(link[component] >> normal_bits, 0);
    }
    expected.push_back(link);
  }
  for (const VectorVariant variant : available_vector_variants()) {
    for (auto& component : links) std::fill(component.begin(), component.end(), std::uint16_t{0});
    Prenormaliser(widths(word_bits, normal_bits), variant)
        .line({words[0].data(), words[1].data(), words[2].data()}, {links[0].data(), links[1].data(), links[2].data()},
              words[0].size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      for (std::size_t component = 0; component < 3; ++component)
        ASSERT_EQ(links[component][i], expected[i][component]) << name_of(variant);
  }
}

TEST(Prenormaliser, IsTheSmallestShiftThatFits) {
  std::mt19937 random(21);
  compare(24, 12, random, 20000);
  for (const std::int64_t word : {8, 12, 23, 25, 26, 32})
    for (const std::int64_t normal : {4, 11, 16}) compare(word, normal, random, 1000);
}

// 004, section 5.2.3: four fixed shifters, of 1, 2, 4 and 8 bits.
TEST(Prenormaliser, HasThePublishedShifters) {
  const Prenormaliser unit(widths(24, 12));
  EXPECT_EQ(unit.largest_shift(), 12U);
  EXPECT_EQ(unit.shifters(), 4U);
  EXPECT_EQ(Prenormaliser(widths(12, 12)).shifters(), 0U);
  EXPECT_EQ(unit.shift_of({0x800000, 0, 0}), 12U);  // the most negative word
  EXPECT_EQ(unit.shift_of({0x7FF, 0xFFFFFF, 0}), 0U);
  EXPECT_EQ(unit.shift_of({0x800, 0, 0}), 1U);
}

}  // namespace
}  // namespace rastertlm::object_processor
