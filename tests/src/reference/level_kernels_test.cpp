// Do all instruction sets give the same sums, to the last bit?
#include "src/reference/level_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "tests/src/reference/random_frames.h"

namespace rastertlm::reference {
namespace {

using AllSums = std::array<KindSums, kPixelKinds>;
using testing_support::FramePair;
using testing_support::random_frames;

class LevelKernelVariants : public testing::TestWithParam<VectorVariant> {
 protected:
  const LevelKernels& kernels_ = level_kernels(GetParam());
  const LevelKernels& baseline_ = level_kernels(VectorVariant::baseline);
};

void expect_equal(const AllSums& sums, const AllSums& wanted) {
  for (std::size_t kind = 0; kind < kPixelKinds; ++kind) {
    SCOPED_TRACE(testing::Message() << "kind " << kind);
    EXPECT_EQ(sums[kind].pixels, wanted[kind].pixels);
    EXPECT_EQ(sums[kind].over_one, wanted[kind].over_one);
    EXPECT_EQ(sums[kind].over_two, wanted[kind].over_two);
    for (std::size_t i = 0; i < kLevelGroup; ++i) {
      EXPECT_EQ(sums[kind].squares[i], wanted[kind].squares[i]);
      EXPECT_EQ(sums[kind].largest_square[i], wanted[kind].largest_square[i]);
      EXPECT_EQ(sums[kind].unrounded_squares[i], wanted[kind].unrounded_squares[i]);
    }
  }
}

std::uint64_t pixels_of(const AllSums& sums) {
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t{0},
                         [](std::uint64_t pixels, const KindSums& one) { return pixels + one.pixels; });
}

TEST_P(LevelKernelVariants, GiveTheSumsOfTheBaseline) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const FramePair pair = random_frames(kLevelGroup * (1 + seed % 9), 1 + seed % 5, seed);
    const LevelPlanes planes{pair.exact.pixels() / kLevelGroup,
                             pair.shown.object.data(),
                             pair.exact.object.data(),
                             reinterpret_cast<const std::uint8_t*>(pair.exact.region.data()),
                             pair.shown.rgb.data(),
                             pair.exact.rgb.rounded_planes().data(),
                             pair.exact.rgb.residual_planes().data()};
    AllSums sums{}, wanted{};
    kernels_.add(planes, sums.data());
    baseline_.add(planes, wanted.data());
    expect_equal(sums, wanted);
    std::uint64_t covered = 0;
    for (std::size_t pixel = 0; pixel < pair.exact.pixels(); ++pixel)
      covered += (pair.shown.object[pixel] | pair.exact.object[pixel]) != 0 ? 1 : 0;
    EXPECT_EQ(pixels_of(sums), covered);
  }
}

TEST_P(LevelKernelVariants, GiveTheChangesOfTheBaseline) {
  std::uint64_t still = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const FramePair before = random_frames(kLevelGroup * (1 + seed % 9), 1 + seed % 5, seed);
    FramePair now = random_frames(before.exact.columns, before.exact.lines, seed + 100);
    std::mt19937 engine(seed);
    for (std::size_t i = 0; i < now.exact.rgb.size(); ++i)  // most stand still
      if (engine() % 8 != 0) now.exact.rgb.set(i, before.exact.rgb[i]);
    std::vector<std::uint8_t> kinds(now.exact.pixels());
    for (std::uint8_t& kind : kinds) kind = static_cast<std::uint8_t>(engine() % 16 | (engine() % 2 == 0 ? 12 : 0));
    const ChangePlanes planes{now.exact.pixels() / kLevelGroup,
                              kinds.data(),
                              now.shown.rgb.data(),
                              now.exact.rgb.rounded_planes().data(),
                              before.shown.rgb.data(),
                              before.exact.rgb.rounded_planes().data(),
                              static_cast<std::int32_t>(seed % 3)};
    AllSums sums{}, wanted{};
    kernels_.add_changes(planes, sums.data());
    baseline_.add_changes(planes, wanted.data());
    expect_equal(sums, wanted);
    still += pixels_of(sums);
  }
  EXPECT_GT(still, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Variants, LevelKernelVariants, testing::ValuesIn(available_vector_variants()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace rastertlm::reference
