// Is a word worth what its binary point says, and signed where it is?
#include "src/analysis/word_worth.h"

#include <gtest/gtest.h>

namespace rastertlm::analysis {
namespace {

// numerics: depth has 15 fraction bits at 512 and 14 at 1024, a normal 22, an edge those of the snapped vertices.
TEST(BinaryPoints, AreThoseOfTheSpecification) {
  const BinaryPoints at_512 = binary_points(24, 512, 512, 5, false);
  EXPECT_EQ(at_512.edge, 5);
  EXPECT_EQ(at_512.depth, 15);
  EXPECT_EQ(at_512.normal, 22);
  EXPECT_EQ(binary_points(24, 1024, 1024, 3, false).depth, 14);
  EXPECT_EQ(binary_points(24, 640, 480, 3, false).depth, 14);
  EXPECT_EQ(binary_points(28, 512, 512, 3, false).depth, 19);
  EXPECT_EQ(binary_points(24, 513, 2, 3, false).depth, 14);
  EXPECT_EQ(binary_points(24, 1, 1, 3, false).depth, 24);
  EXPECT_EQ(binary_points(8, 16384, 1, 0, false).depth, -6);
  EXPECT_EQ(binary_points(24, 512, 512, 12, true).edge, 0) << "a scale of its own";
}

TEST(WordWorth, SaysWhatAWordIs) {
  const BinaryPoints points = binary_points(24, 512, 512, 5, false);
  struct Case {
    std::size_t index;
    std::uint32_t word;
    const char* meaning;
    double value;
    const char* unit;
  };
  const std::vector<Case> cases{{0, 0x0000c5, "edge 0 A", 197.0 / 32, "px"},
                                {1, 0xfffe26, "edge 0 B", -474.0 / 32, "px"},
                                {5, 0x800000, "edge 1 C'", -262144.0, "px2"},
                                {8, 0x7fffff, "edge 2 C'", 262144.0 - 1.0 / 32, "px2"},
                                {9, 0xffffff, "depth A", -1.0 / 32768, "units/column"},
                                {10, 0x008000, "depth B", 1.0, "units/line"},
                                {11, 0xffffff, "depth C'", 512.0 - 1.0 / 32768, "units"},
                                {12, 0x400000, "normal x A", 1.0, "1/column"},
                                {16, 0xc00000, "normal y B", -1.0, "1/line"},
                                {20, 0x3fffff, "normal z C'", 1.0 - 1.0 / 4194304, "1"},
                                {21, 0x0f, "material", 15.0, "number"}};
  for (const Case& c : cases) {
    const WordWorth worth = word_worth(points, 24, c.index, c.word);
    EXPECT_EQ(worth.meaning, c.meaning);
    EXPECT_EQ(worth.value, c.value) << c.meaning;
    EXPECT_EQ(worth.unit, c.unit) << c.meaning;
  }
}

TEST(WordWorth, GivesScaledEdgesAsTheyAre) {
  const WordWorth worth = word_worth(binary_points(32, 512, 512, 12, true), 32, 3, 0xfffffffe);
  EXPECT_EQ(worth.meaning, "edge 1 A");
  EXPECT_EQ(worth.value, -2.0);
  EXPECT_EQ(worth.unit, "steps/column");
}

}  // namespace
}  // namespace rastertlm::analysis
