// Does every object get the board and slot of the rule, and is what finds no processor refused or counted?
#include "modules/host/assignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "src/base/errors.h"

namespace rastertlm::host {
namespace {

HostParameters machine(std::int64_t units, std::int64_t processors, Assignment assignment,
                       Overflow overflow = Overflow::error) {
  HostParameters parameters;
  parameters.computation_units = units;
  parameters.processors_per_unit = processors;
  parameters.assignment = assignment;
  parameters.overflow = overflow;
  return parameters;
}

// Dealt like cards: 7 objects to 3 boards of 3.
TEST(Assignment, DealsInTurn) {
  const SlotMap map = assign_objects(7, machine(3, 3, Assignment::round_robin));
  const std::vector<std::vector<std::uint32_t>> objects{{0, 3, 6}, {1, 4}, {2, 5}};
  ASSERT_EQ(map.boards.size(), 3U);
  for (std::size_t board = 0; board < 3; ++board) {
    ASSERT_EQ(map.boards[board].size(), objects[board].size()) << board;
    for (std::uint32_t slot = 0; slot < objects[board].size(); ++slot) {
      EXPECT_EQ(map.boards[board][slot].object, objects[board][slot]);
      EXPECT_EQ(map.boards[board][slot].slot, slot);
    }
  }
  EXPECT_EQ(map.dropped, 0U);
}

TEST(Assignment, FillsBoardsInTurn) {
  const SlotMap map = assign_objects(7, machine(3, 3, Assignment::block));
  const std::vector<std::vector<std::uint32_t>> objects{{0, 1, 2}, {3, 4, 5}, {6}};
  for (std::size_t board = 0; board < 3; ++board) {
    ASSERT_EQ(map.boards[board].size(), objects[board].size()) << board;
    for (std::uint32_t slot = 0; slot < objects[board].size(); ++slot) {
      EXPECT_EQ(map.boards[board][slot].object, objects[board][slot]);
      EXPECT_EQ(map.boards[board][slot].slot, slot);
    }
  }
}

// No slot twice, no object twice, none forgotten, slots in order; dealt boards differ by one object at most.
RC_GTEST_PROP(Assignment, EveryObjectHasASlotOfItsOwn, ()) {
  const auto units = *rc::gen::inRange<std::int64_t>(1, 20);
  const auto processors = *rc::gen::inRange<std::int64_t>(1, 40);
  const auto objects = *rc::gen::inRange<std::size_t>(0, 1000);
  const auto assignment = *rc::gen::element(Assignment::round_robin, Assignment::block);
  const SlotMap map = assign_objects(objects, machine(units, processors, assignment, Overflow::drop));
  const std::size_t places = static_cast<std::size_t>(units * processors);
  RC_ASSERT(map.boards.size() == static_cast<std::size_t>(units));
  std::set<std::uint32_t> seen;
  std::size_t smallest = objects;
  std::size_t largest = 0;
  for (const auto& board : map.boards) {
    smallest = std::min(smallest, board.size());
    largest = std::max(largest, board.size());
    for (std::size_t i = 0; i < board.size(); ++i) {
      RC_ASSERT(board[i].slot == i);
      RC_ASSERT(board[i].slot < static_cast<std::uint32_t>(processors));
      RC_ASSERT(seen.insert(board[i].object).second);
    }
  }
  RC_ASSERT(seen.size() == std::min(objects, places));
  if (!seen.empty()) RC_ASSERT(*seen.rbegin() + 1 == seen.size());  // the first ones
  RC_ASSERT(map.dropped == objects - seen.size());
  if (assignment == Assignment::round_robin) RC_ASSERT(largest - smallest <= 1U);
}

TEST(Assignment, RefusesMoreObjectsThanProcessorsWithBothNumbers) {
  EXPECT_NO_THROW(assign_objects(1024, machine(8, 128, Assignment::round_robin)));
  try {
    assign_objects(1025, machine(8, 128, Assignment::block));
    FAIL() << "1025 objects on 1024 processors";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1U);
    EXPECT_EQ(error.diagnostics()[0].key, "host.processors_per_unit");
    EXPECT_THAT(error.diagnostics()[0].message,
                testing::AllOf(testing::HasSubstr("1025 objects"), testing::HasSubstr("1024 object processors"),
                               testing::HasSubstr("8 units of 128"), testing::HasSubstr("host.overflow = \"drop\"")));
  }
}

TEST(Assignment, DropsTheLastOnesWhereAsked) {
  const SlotMap map = assign_objects(10, machine(2, 3, Assignment::round_robin, Overflow::drop));
  EXPECT_EQ(map.dropped, 4U);
  EXPECT_EQ(map.boards[0].size() + map.boards[1].size(), 6U);
}

}  // namespace
}  // namespace rastertlm::host
