#include "modules/quadric_processor/quadric_words.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "src/base/fixed_point.h"

namespace rastertlm::quadric_processor {
namespace {

PlaneWords any_plane(unsigned bits) {
  const auto word = [bits] { return *rc::gen::arbitrary<std::uint64_t>() & low_mask(bits); };
  return {word(), word(), word()};
}

QuadricWords any_quadric() {
  const auto wide = [] { return *rc::gen::arbitrary<std::uint64_t>() & low_mask(60); };
  const auto narrow = [] { return *rc::gen::arbitrary<std::uint32_t>(); };
  QuadricWords words;
  words.discriminant = {wide(), wide(), wide(), wide(), wide(), wide()};
  words.middle = any_plane(48);
  for (LinearWords& plane : words.normal) plane = {narrow(), narrow(), narrow()};
  for (std::int32_t& k : words.normal_of_root) k = *rc::gen::arbitrary<std::int32_t>();
  for (CapWords& cap : words.caps)
    cap = {static_cast<CapKeeps>(*rc::gen::inRange(0, 4)), any_plane(48), {narrow(), narrow(), narrow()}};
  words.part = static_cast<RayPart>(*rc::gen::inRange(0, 3));
  words.root_shift = *rc::gen::inRange(-32, 32);
  words.material = *rc::gen::inRange(0U, 256U);
  return words;
}

RC_GTEST_PROP(QuadricWordsTest, StandOnTheBusAsTheyAreRead, ()) {
  const QuadricWords words = any_quadric();
  RC_ASSERT(to_quadric(to_image(words)) == words);
}

// Every word of the image is read, and none is read twice: a changed bit is a changed slot.
RC_GTEST_PROP(QuadricWordsTest, EveryWordMatters, ()) {
  const QuadricImage image = to_image(any_quadric());
  const QuadricWords words = to_quadric(image);
  for (std::size_t i = 0; i < kMostWords; ++i) {
    QuadricImage changed = image;
    changed[i] ^= 1U;
    RC_ASSERT(!(to_quadric(changed) == words));
    RC_ASSERT(to_image(to_quadric(changed))[i] == changed[i]);
  }
}

TEST(QuadricWordsTest, CountsOfTheBus) {
  EXPECT_EQ(words_of_slot(0), 31U);
  EXPECT_EQ(words_of_slot(2), 49U);
  EXPECT_EQ(words_of_slot(kMostCaps), kMostWords);
}

}  // namespace
}  // namespace rastertlm::quadric_processor
