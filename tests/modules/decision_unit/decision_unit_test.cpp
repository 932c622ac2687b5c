// Do pipeline and tree show the same nearest object, and do their figures equal what counting gives?
#include "modules/decision_unit/decision_unit.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <vector>

namespace rastertlm::decision_unit {
namespace {

constexpr std::uint32_t kBackground = 0xFFFFFF;

// Lines of boards with few depths, so that ties are frequent; words tell the board and the pixel.
std::vector<frame::FragmentLine> random_lines(std::uint32_t seed) {
  std::mt19937 random(seed);
  const std::size_t columns = 1 + random() % 200;
  std::vector<frame::FragmentLine> lines(1 + random() % 9);
  for (std::size_t board = 0; board < lines.size(); ++board) {
    frame::FragmentLine& line = lines[board];
    line.resize(columns);
    for (int span = 0; span < static_cast<int>(random() % 4); ++span) {
      const std::size_t begin = random() % columns;
      const std::size_t end = begin + 1 + random() % (columns - begin);
      line.extend(begin, end, kBackground);
      for (std::size_t i = begin; i < end; ++i) {
        ++line.coverage[i];
        const auto depth = static_cast<std::uint32_t>(random() % 4);
        if (depth >= line.depth[i]) continue;
        line.depth[i] = depth;
        line.normal_x[i] = static_cast<std::uint16_t>(random());
        line.normal_y[i] = static_cast<std::uint16_t>(random());
        line.normal_z[i] = static_cast<std::uint16_t>(random());
        line.material[i] = static_cast<std::uint8_t>(board);
        line.object[i] = static_cast<std::uint32_t>(1 + board * columns + i);
      }
    }
  }
  return lines;
}

struct Merged {
  frame::FragmentLine line;
  DecisionCounters counters;
};

Merged merged(std::vector<frame::FragmentLine> lines, Topology topology) {
  DecisionUnit unit({.topology = topology}, kBackground);
  std::vector<frame::FragmentLine*> pointers;
  for (frame::FragmentLine& line : lines) pointers.push_back(&line);
  unit.merge(pointers);
  return {lines[0], unit.counters()};
}

// Pixel by pixel, board by board.
void compare(const std::vector<frame::FragmentLine>& lines, const Merged& result) {
  std::uint64_t in = 0;
  std::uint64_t kept = 0;
  for (std::size_t i = 0; i < lines[0].columns(); ++i) {
    const frame::FragmentLine* nearest = nullptr;
    std::uint32_t coverage = 0;
    for (const frame::FragmentLine& line : lines) {
      if (i < line.begin || i >= line.end) continue;
      coverage += line.coverage[i];
      if (line.object[i] == 0) continue;
      ++in;
      if (nearest == nullptr || line.depth[i] < nearest->depth[i]) nearest = &line;
    }
    kept += nearest != nullptr ? 1 : 0;
    if (i < result.line.begin || i >= result.line.end) {
      RC_ASSERT(coverage == 0U);
      continue;
    }
    RC_ASSERT(result.line.coverage[i] == coverage);
    RC_ASSERT(result.line.object[i] == (nearest != nullptr ? nearest->object[i] : 0U));
    RC_ASSERT(result.line.depth[i] == (nearest != nullptr ? nearest->depth[i] : kBackground));
    if (nearest == nullptr) continue;
    RC_ASSERT(result.line.normal_x[i] == nearest->normal_x[i]);
    RC_ASSERT(result.line.normal_y[i] == nearest->normal_y[i]);
    RC_ASSERT(result.line.normal_z[i] == nearest->normal_z[i]);
    RC_ASSERT(result.line.material[i] == nearest->material[i]);
  }
  RC_ASSERT(result.counters.fragments_in == in);
  RC_ASSERT(result.counters.fragments_kept == kept);
  RC_ASSERT(result.counters.fragments_hidden == in - kept);
}

RC_GTEST_PROP(DecisionUnit, PipelineAndTreeKeepTheNearestOfTheLowestNumber, (std::uint32_t seed)) {
  const std::vector<frame::FragmentLine> lines = random_lines(seed);
  const Merged pipeline = merged(lines, Topology::pipeline);
  const Merged tree = merged(lines, Topology::tree);
  compare(lines, pipeline);
  compare(lines, tree);
  RC_ASSERT(pipeline.line.begin == tree.line.begin);
  RC_ASSERT(pipeline.line.end == tree.line.end);
}

// A tree built by pairing what is left, a level at a time.
struct CountedTree {
  std::uint64_t levels = 0, comparators = 0, registers = 0;
};
CountedTree count_tree(std::uint64_t leaves) {
  CountedTree tree;
  while (leaves > 1) {
    tree.comparators += leaves / 2;
    leaves = leaves / 2 + leaves % 2;
    tree.registers += leaves;  // nodes, and the branch that waits
    ++tree.levels;
  }
  return tree;
}

TEST(DecisionLogic, EqualsCountingForEveryNumberOfProcessors) {
  const LinkWidth link;
  for (std::uint64_t n = 1; n <= 4096; ++n) {
    const CountedTree tree = count_tree(n);
    const DecisionLogic logic = decision_logic({.topology = Topology::tree}, n, link, 1);
    ASSERT_EQ(tree_levels(n), tree.levels) << n;
    ASSERT_EQ(logic.comparators, n - 1) << n;
    ASSERT_EQ(tree.comparators, n - 1) << n;
    ASSERT_EQ(logic.register_bits, tree.registers * 64) << n;
    ASSERT_EQ(latency(Topology::tree, n, Cycles(1)), Cycles(tree.levels)) << n;
    ASSERT_EQ(skew(Topology::tree, n, Cycles(1)), Cycles(0)) << n;

    const DecisionLogic chain = decision_logic({.topology = Topology::pipeline}, n, link, 1);
    ASSERT_EQ(chain.comparators, n);
    ASSERT_EQ(chain.register_bits, n * 64);
    ASSERT_EQ(latency(Topology::pipeline, n, Cycles(1)), Cycles(n));
    ASSERT_EQ(skew(Topology::pipeline, n, Cycles(1)), Cycles(n - 1));
  }
  EXPECT_EQ(tree_levels(1'000'000), 20U);
}

TEST(DecisionLogic, SlowerComparatorsCostCyclesAndRegisters) {
  EXPECT_EQ(latency(Topology::tree, 1024, Cycles(3)), Cycles(30));
  EXPECT_EQ(latency(Topology::pipeline, 1024, Cycles(3)), Cycles(3072));
  EXPECT_EQ(skew(Topology::pipeline, 1024, Cycles(3)), Cycles(3069));
  EXPECT_EQ(decision_logic({.topology = Topology::pipeline}, 10, {}, 3).register_bits, 10U * 3U * 64U);
}

// 64 bits, 32 double-clocked pins a direction.
TEST(DecisionLogic, PinsOfThePublishedLink) {
  EXPECT_EQ(LinkWidth{}.bits(), 64U);
  const DecisionLogic tree = decision_logic({}, 1024, {}, 1);
  EXPECT_EQ(tree.link_pins, 32U);
  EXPECT_EQ(tree.processor_pins, 32U);
  EXPECT_EQ(tree.node_pins, 96U);
  const DecisionLogic chain = decision_logic({.topology = Topology::pipeline}, 1024, {}, 1);
  EXPECT_EQ(chain.processor_pins, 64U);
  EXPECT_EQ(chain.node_pins, 0U);
  EXPECT_EQ(decision_logic({.double_clocked = false}, 1024, {}, 1).link_pins, 64U);
  EXPECT_EQ(decision_logic({}, 2, {.depth_bits = 25, .normal_bits = 12, .material_bits = 4}, 1).link_pins, 33U);
}

}  // namespace
}  // namespace rastertlm::decision_unit
