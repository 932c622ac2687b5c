// Are the planes that comparisons read those of the levels, whichever way these came?
#include "src/frame/exact_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/frame/fields.h"

namespace rastertlm::frame {
namespace {

// On halves, beside them and anywhere.
std::vector<double> random_levels(std::size_t pixels, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::vector<double> levels;
  while (levels.size() < 3 * pixels) {
    const double half = 0.5 * static_cast<double>(engine() % 511);
    const double ways[] = {half, std::nextafter(half, 0.0), std::min(std::nextafter(half, 256.0), 255.0),
                           std::min(half + static_cast<double>(engine() % 1000) / 1000.0, 255.0),
                           engine() % 2 == 0 ? 0.0 : 1e-300};
    levels.push_back(ways[engine() % 5]);
  }
  return levels;
}

void expect_planes(const ExactLevels& levels, const std::vector<double>& wanted) {
  constexpr std::size_t kGroup = ExactLevels::kGroup;
  ASSERT_EQ(levels.values(), wanted);
  const std::size_t groups = (wanted.size() / 3 + kGroup - 1) / kGroup;
  ASSERT_EQ(levels.rounded_planes().size(), 3 * kGroup * groups);
  ASSERT_EQ(levels.residual_planes().size(), 3 * kGroup * groups);
  for (std::size_t pixel = 0; pixel < wanted.size() / 3; ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      const double level = wanted[3 * pixel + c];
      const std::size_t at = (pixel / kGroup * 3 + c) * kGroup + pixel % kGroup;
      const double rounded = std::floor(level + 0.5);
      ASSERT_EQ(levels.rounded_planes()[at], rounded) << level;
      ASSERT_EQ(levels.rounded(3 * pixel + c), rounded) << level;
      ASSERT_LE(std::abs(levels.residual_planes()[at]), 0.5F) << level;
      ASSERT_LE(std::abs(rounded + levels.residual_planes()[at] - level), 1.0 / (1 << 26)) << level;
    }
}

TEST(ExactLevels, AreTheSameSetOneByOneOrAtOnce) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const std::size_t pixels = 1 + seed * 7 % 50;
    const std::vector<double> wanted = random_levels(pixels, seed);
    ExactLevels one_by_one, at_once;
    one_by_one.resize(pixels);
    expect_planes(one_by_one, std::vector<double>(3 * pixels, 0.0));
    for (std::size_t i = 0; i < wanted.size(); ++i) one_by_one.set(i, wanted[i]);
    at_once.assign(wanted);
    expect_planes(one_by_one, wanted);
    expect_planes(at_once, wanted);
  }
}

// Lines that are whole groups, and others.
TEST(ExactLevels, AreWovenWithTheirPlanes) {
  for (const std::size_t columns : {32U, 16U, 5U, 17U}) {
    constexpr std::size_t kLines = 6;
    ExactFrame even, odd, woven;
    for (ExactFrame* field : {&even, &odd}) {
      field->resize(columns, kLines);
      field->rgb.assign(random_levels(columns * kLines, field == &even ? 1 : 2));
    }
    copy_lines(even, 0, 2, woven);
    copy_lines(odd, 1, 2, woven);
    std::vector<double> wanted;
    for (std::size_t i = 0; i < 3 * columns * kLines; ++i)
      wanted.push_back((i / (3 * columns) % 2 == 0 ? even : odd).rgb[i]);
    expect_planes(woven.rgb, wanted);
  }
}

}  // namespace
}  // namespace rastertlm::frame
