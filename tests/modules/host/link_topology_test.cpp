// Is every unit fed by exactly one processor, over no more links than a processor has, and are the hops those walked?
#include "modules/host/link_topology.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace rastertlm::host {
namespace {

using Units = std::vector<std::size_t>;

// 004's transputers have four links: the animation unit feeds three, each of them three.
TEST(LinkTopology, TreeOfTransputers) {
  const auto fed = [](std::size_t node) { return children(node, 8, LinkTopology::tree, 4); };
  EXPECT_EQ(fed(0), (Units{0, 1, 2}));
  EXPECT_EQ(fed(1), (Units{3, 4, 5}));
  EXPECT_EQ(fed(2), (Units{6, 7}));
  for (std::size_t node = 3; node <= 8; ++node) EXPECT_TRUE(fed(node).empty()) << node;
  const Units expected{1, 1, 1, 2, 2, 2, 2, 2};
  for (std::size_t unit = 0; unit < 8; ++unit) EXPECT_EQ(hops(unit, LinkTopology::tree, 4), expected[unit]) << unit;
}

TEST(LinkTopology, Chain) {
  for (std::size_t node = 0; node < 5; ++node)
    EXPECT_EQ(children(node, 5, LinkTopology::chain, 4), (Units{node})) << node;
  EXPECT_TRUE(children(5, 5, LinkTopology::chain, 4).empty());
  for (std::size_t unit = 0; unit < 5; ++unit) EXPECT_EQ(hops(unit, LinkTopology::chain, 4), unit + 1);
}

// Two links are one to be fed by and one to feed: a chain whatever it is called.
TEST(LinkTopology, TwoLinksMakeAChain) {
  for (std::size_t node = 0; node <= 6; ++node)
    EXPECT_EQ(children(node, 6, LinkTopology::tree, 2), children(node, 6, LinkTopology::chain, 2));
}

// By a walk from the animation unit, breadth first.
RC_GTEST_PROP(LinkTopology, EveryUnitIsReachedOnceInAsManyHopsAsWalked, ()) {
  const auto units = *rc::gen::inRange<std::size_t>(1, 400);
  const auto links = *rc::gen::inRange<std::size_t>(2, 12);
  const auto topology = *rc::gen::element(LinkTopology::tree, LinkTopology::chain);
  std::vector<std::size_t> walked(units, 0);
  std::deque<std::pair<std::size_t, std::size_t>> to_visit{{0, 0}};  // node, hops
  std::size_t reached = 0;
  std::size_t deepest = 0;
  while (!to_visit.empty()) {
    const auto [node, steps] = to_visit.front();
    to_visit.pop_front();
    const Units fed = children(node, units, topology, links);
    RC_ASSERT(fed.size() <= (topology == LinkTopology::chain ? 1 : links - 1));
    for (const std::size_t unit : fed) {
      RC_ASSERT(unit < units);
      RC_ASSERT(walked[unit] == 0U);
      walked[unit] = steps + 1;
      deepest = std::max(deepest, steps + 1);
      ++reached;
      to_visit.emplace_back(unit + 1, steps + 1);
    }
  }
  RC_ASSERT(reached == units);
  for (std::size_t unit = 0; unit < units; ++unit) RC_ASSERT(hops(unit, topology, links) == walked[unit]);
  // No deeper than it must be: the levels above the deepest could not hold them all.
  std::size_t held = 0;
  std::size_t level = 1;
  const std::size_t fan_out = topology == LinkTopology::chain ? 1 : links - 1;
  for (std::size_t depth = 1; depth < deepest; ++depth) held += level *= fan_out;
  RC_ASSERT(held < units);
}

}  // namespace
}  // namespace rastertlm::host
