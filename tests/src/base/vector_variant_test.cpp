// Is the best instruction set chosen, or the one that is asked for, and an unknown one refused?
#include "src/base/vector_variant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/base/errors.h"

namespace rastertlm {
namespace {

TEST(VectorVariant, EveryProcessorHasTheBaseline) {
  const auto available = available_vector_variants();
  ASSERT_FALSE(available.empty());
  EXPECT_EQ(available.front(), VectorVariant::baseline);
  EXPECT_TRUE(std::is_sorted(available.begin(), available.end()));
}

TEST(VectorVariant, TheBestIsTakenUnlessOneIsNamed) {
  EXPECT_EQ(vector_variant(""), available_vector_variants().back());
  for (const VectorVariant variant : available_vector_variants()) EXPECT_EQ(vector_variant(name_of(variant)), variant);
}

TEST(VectorVariant, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  try {
    vector_variant("avx3");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("RASTERTLM_VECTOR"), testing::HasSubstr("avx3"),
                                             testing::HasSubstr("baseline")));
  }
}

}  // namespace
}  // namespace rastertlm
