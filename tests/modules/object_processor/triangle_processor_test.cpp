// Is the processor's address map the one of the host bus, and do its counts follow from its widths?
#include "modules/object_processor/triangle_processor.h"

#include <gtest/gtest.h>

#include <set>

#include "modules/object_processor/line_evaluator.h"

namespace rastertlm::object_processor {
namespace {

TEST(TriangleProcessor, HasTwentyOneCoefficientsAndAMaterial) {
  EXPECT_EQ(kCoefficients, 21U);
  EXPECT_EQ(kWords, 22U);
  TriangleWords triangle;
  std::uint32_t next = 100;
  for (LinearWords* linear : {&triangle.edges[0], &triangle.edges[1], &triangle.edges[2], &triangle.depth,
                              &triangle.normals[0], &triangle.normals[1], &triangle.normals[2]}) {
    linear->a = next++;
    linear->b = next++;
    linear->c = next++;
  }
  triangle.material = next;
  const ProcessorWords words = to_words(triangle);
  for (std::uint32_t index = 0; index < kWords; ++index) EXPECT_EQ(words[index], 100 + index);
  EXPECT_EQ(to_triangle(words), triangle);
}

TEST(TriangleProcessor, ParkedWordsAreNegativeEverywhere) {
  for (unsigned bits = 8; bits <= 32; ++bits) {
    const WordFormat format(bits);
    for (const LinearWords& edge : parked_triangle(bits).edges) {
      EXPECT_EQ(format.at(edge, 0, 0) >> (bits - 1), 1U);
      EXPECT_EQ(format.at(edge, 16383, 16383) >> (bits - 1), 1U);
    }
    EXPECT_TRUE(touched_lines(parked_triangle(bits).edges, format, 512, 512).empty());
  }
}

TEST(TriangleProcessor, IsParkedByOneConstantNegativeEdge) {
  TriangleWords triangle;
  for (LinearWords& edge : triangle.edges) edge = {1, 0, 0};
  EXPECT_FALSE(is_parked(triangle, 24));
  for (LinearWords& edge : triangle.edges) {
    const LinearWords before = edge;
    edge = {0, 0, 0xffffff};
    EXPECT_TRUE(is_parked(triangle, 24));
    edge = {0, 0, 0x800000};
    EXPECT_TRUE(is_parked(triangle, 24));
    for (const LinearWords& other : {LinearWords{0, 0, 0x7fffff}, {1, 0, 0xffffff}, {0, 0xffffff, 0xffffff}}) {
      edge = other;
      EXPECT_FALSE(is_parked(triangle, 24));
    }
    edge = before;
  }
  EXPECT_TRUE(is_parked(parked_triangle(32), 32));
}

// Seven EP1 of two 12-bit slices: 2 RAMs of 3 words, a word of slice registers and one of RAM output, one 12-bit
// synchronisation register and one carry flip-flop each; the material and the pre-normalised normal.
TEST(TriangleProcessor, CountsThePublishedHardware) {
  const ObjectProcessorParameters parameters;
  const ProcessorLogic logic = triangle_processor_logic(parameters, 4);
  EXPECT_EQ(logic.ram_bits, 7U * 6U * 24U);
  EXPECT_EQ(logic.register_bits, 7U * (24U + 24U + 12U + 1U) + 36U + 4U);
  EXPECT_EQ(logic.adders, 14U);
  EXPECT_EQ(logic.adder_bits, 7U * 24U);
  EXPECT_EQ(logic.comparators, 1U);
  EXPECT_EQ(logic.shifters, 12U);
}

// 4 ns a bit, so that 24 bits take 96 ns and 12 bits 48 of the 60 ns.
TEST(ObjectProcessorParameters, TwoSlicesFitTheNominalClock) {
  ObjectProcessorParameters parameters;
  EXPECT_DOUBLE_EQ(parameters.adder_delay_ns(), 48.0);
  EXPECT_EQ(parameters.slices(), 2U);
  EXPECT_EQ(parameters.slices_that_fit(60.0), 2U);
  EXPECT_EQ(parameters.slices_that_fit(96.0), 1U);
  EXPECT_EQ(parameters.slices_that_fit(95.9), 2U);
  EXPECT_EQ(parameters.slices_that_fit(3.9), 0U);
  parameters.slice_bits = 24;
  EXPECT_DOUBLE_EQ(parameters.adder_delay_ns(), 96.0);
}

TEST(ObjectProcessorParameters, AreDeclaredOnceAndChecked) {
  ObjectProcessorParameters parameters;
  const parameter::Table table = parameter::view(parameters);
  std::set<std::string> paths;
  for (const parameter::Parameter& declared : table.parameters()) {
    EXPECT_TRUE(paths.insert(declared.path).second) << declared.path;
    EXPECT_FALSE(declared.about.description.empty()) << declared.path;
    EXPECT_FALSE(declared.about.moves.empty()) << declared.path;
  }
  EXPECT_EQ(paths.size(), 11U);
  table.find("ep1.carry_clock")->set(std::string("clock2"));
  EXPECT_EQ(parameters.carry_clock, CarryClock::clock2);

  Diagnostics diagnostics;
  parameters.check(diagnostics, "m.toml");
  EXPECT_TRUE(diagnostics.empty());
  parameters.slice_bits = 25;
  parameters.check(diagnostics, "m.toml");
  ASSERT_EQ(diagnostics.list().size(), 1U);
  EXPECT_EQ(diagnostics.list()[0].key, "object_processor.slice_bits");
}

}  // namespace
}  // namespace rastertlm::object_processor
