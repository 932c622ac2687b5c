// Are a unit's quadrics those of the set-up of every solid alone, parked once they have left, and refused by name?
#include "modules/host/quadric_computation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "modules/set_up/solid_in_eye_space.h"
#include "src/base/errors.h"
#include "tests/modules/host/resident_world.h"

namespace rastertlm::host {
namespace {

using Number = geometry::Counted<double>;
using set_up::QuadricOutcome;
using testing::HasSubstr;

set_up::QuadricFormat quadric_format() { return {{}, {kWordBits, kColumns, kLines, set_up::EdgeForm::snapped}}; }

// Meshes of some triangles and ellipsoids, one after another in any order, at places of their own in every frame.
struct SolidWorld : World {
  std::deque<geometry::Solid> solids;

  geometry::Solid& add_solid(bool moves) {
    solids.emplace_back();
    solids.back().quadric[3][3] = -1.0;
    resident.objects.push_back({nullptr, false, moves, &solids.back()});
    return solids.back();
  }
  void fill(std::mt19937& random, std::size_t frames) {
    const std::size_t objects = 1 + random() % 6;
    for (std::size_t i = 0; i < objects; ++i) {
      const bool moves = random() % 2 == 0;
      if (random() % 3 == 0) {
        add_random_triangles(add(true, moves), random() % 4, 1.4, random);
      } else {
        geometry::Solid& solid = add_solid(moves);
        for (int k = 0; k < 3; ++k) solid.quadric[k][k] = 0.2 + static_cast<double>(random() % 100) / 50;
        if (random() % 2 == 0) solid.planes = {{0, 0.6, 0.8, -0.3}};
        solid.material = static_cast<std::uint16_t>(random() % 256);
      }
    }
    for (std::size_t frame = 0; frame < frames; ++frame) {
      places.emplace_back();
      for (std::size_t i = 0; i < objects; ++i) {
        const bool same = frame > 0 && !resident.objects[i].moves;
        places[frame].push_back(same ? places[0][i]
                                     : glm::dvec3(static_cast<double>(random() % 2000) / 100 - 10,
                                                  static_cast<double>(random() % 200) / 100 - 1, -10.0));
      }
    }
  }
  // By number among the solids: of the machine's objects, and of the scene's.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
    std::uint32_t number = 0;
    for (std::uint32_t i = 0; i < resident.objects.size(); ++i) {
      if (resident.objects[i].solid != nullptr)
        result.emplace_back(number++, i);
      else
        number += static_cast<std::uint32_t>(resident.objects[i].mesh->triangles.size());
    }
    return result;
  }
};

template <class T>
set_up::QuadricSetUp alone(const SolidWorld& world, std::uint32_t object, std::int64_t frame,
                           const set_up::QuadricFormat& format) {
  const geometry::Pose pose = world.pose(frame);
  const geometry::Solid& solid = *world.resident.objects[object].solid;
  const set_up::EyeSolid placed = set_up::solid_in_eye_space<T>(solid, pose.object_to_eye[object]);
  return set_up::set_up_quadric<T>(placed.quadric, placed.planes, solid.material,
                                   set_up::screen_to_eye<T>(pose.eye_to_clip, {kColumns, kLines}), format);
}

RC_GTEST_PROP(QuadricComputation, SlotsHoldWhatIsSeenOfEverySolid, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  constexpr std::size_t kFrames = 4;
  SolidWorld world;
  world.fill(random, kFrames);
  const auto numbers = world.numbers();
  HostParameters parameters;
  parameters.computation_units = 1 + static_cast<std::int64_t>(random() % 3);
  parameters.assignment = *rc::gen::element(Assignment::round_robin, Assignment::block);
  const set_up::QuadricFormat format = quadric_format();
  bool outside = false;
  for (const auto& owners : assign_solids(numbers.size(), parameters, 6).boards) {
    QuadricComputation computation(world.resident, format, owners);
    RC_ASSERT(computation.solids() == owners.size());
    std::map<std::uint32_t, QuadricLoad> slots;  // as the board has them
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
      const FrameWork work = Animation(world.resident, false).frame_work(static_cast<std::int64_t>(frame), frame == 0);
      const std::vector<QuadricLoad>& loads = computation.set_up(work);
      RC_ASSERT(computation.before().size() == loads.size());
      for (const QuadricLoad& load : loads) {
        RC_ASSERT(!load.park || (slots.contains(load.slot) && !slots.at(load.slot).park));
        slots[load.slot] = load;
      }
      std::size_t drawn = 0;
      for (const SlotOwner& owner : owners) {
        const auto [number, object] = numbers[owner.object];
        const set_up::QuadricSetUp expected = alone<double>(world, object, static_cast<std::int64_t>(frame), format);
        if (expected.outcome == QuadricOutcome::drawn) {
          ++drawn;
          RC_ASSERT(slots.at(owner.slot).object == number);
          RC_ASSERT(!slots.at(owner.slot).park);
          RC_ASSERT((slots.at(owner.slot).words == expected.words));
        } else if (slots.contains(owner.slot)) {
          RC_ASSERT(slots.at(owner.slot).park);
          RC_ASSERT((slots.at(owner.slot).words.discriminant == expected.words.discriminant));
        }
      }
      outside = outside || drawn < owners.size();
      RC_ASSERT(computation.counts().drawn == drawn);
      RC_ASSERT(computation.counts().outside == owners.size() - drawn);
    }
  }
  RC_CLASSIFY(outside, "some are outside");
}

TEST(QuadricComputation, WhatDoesNotMoveIsNotWrittenAgain) {
  SolidWorld world;
  world.add_solid(false);
  world.add_solid(true);
  world.places = {{{-2, 0, -10}, {2, 0, -10}}, {{-2, 0, -10}, {2, 1, -10}}};
  QuadricComputation computation(world.resident, quadric_format(), {{0, 3}, {1, 5}});
  const Animation animation(world.resident, false);
  EXPECT_EQ(computation.set_up(animation.frame_work(0, true)).size(), 2U);
  const auto& loads = computation.set_up(animation.frame_work(1, false));
  ASSERT_EQ(loads.size(), 1U);
  EXPECT_EQ(loads[0].slot, 5U);
  EXPECT_EQ(loads[0].object, 1U);
}

// Those of the code itself: a way back from the screen once, then every solid's. A load is written when its own are
// done.
TEST(QuadricComputation, OperationsAreThoseOfTheWork) {
  SolidWorld world;
  world.add_solid(false);
  world.add_solid(false).planes = {{0, 0, 1, 0}};
  world.places = {{{-2, 0, -10}, {2, 0, -10}}};
  const set_up::QuadricFormat format = quadric_format();
  const auto counted = [](auto&& work) {
    const geometry::OperationCounts start = geometry::operation_counts;
    work();
    return geometry::operation_counts - start;
  };
  const auto back = counted([&] { set_up::screen_to_eye<Number>(world.eye_to_clip, {kColumns, kLines}); });
  const auto first = counted([&] { alone<Number>(world, 0, 0, format); });
  const auto second = counted([&] { alone<Number>(world, 1, 0, format); });
  EXPECT_GT(back.multiply, 100U);
  EXPECT_GT(first.flops(), back.flops() + 245U);
  QuadricComputation computation(world.resident, format, {{0, 0}, {1, 1}});
  const FrameWork work = Animation(world.resident, true).frame_work(0, true);
  computation.set_up(work);
  EXPECT_EQ(computation.before().at(0), first);
  geometry::OperationCounts both = first;
  both += second - back;
  EXPECT_EQ(computation.before().at(1), both);
  EXPECT_EQ(computation.operations(), both);
  computation.set_up(work);  // the projection is as it was
  EXPECT_EQ(computation.before().at(1), both - back);
  both += both - back;
  EXPECT_EQ(computation.operations(), both);
  EXPECT_TRUE(computation.set_up(work, false).size() == 2U && computation.before().empty());
}

// Four planes where a processor has caps for two.
TEST(QuadricComputation, RefusesByObjectAndFrame) {
  SolidWorld world;
  std::mt19937 random(1);
  add_random_triangles(world.add(false, false), 3, 1.0, random);
  world.add_solid(false).planes = {{0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
  world.add_solid(true);
  world.places.assign(8, {{0, 0, -10}, {0, 0, -10}, {2, 0, -10}});
  set_up::QuadricFormat format = quadric_format();
  const FrameWork work = Animation(world.resident, false).frame_work(7, true);
  try {
    QuadricComputation(world.resident, format, {{0, 0}, {1, 1}}).set_up(work);
    FAIL() << "three planes on two caps";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 2U);
    EXPECT_EQ(error.diagnostics()[0].key, "quadric_processor.caps");
    EXPECT_THAT(error.diagnostics()[0].message,
                testing::AllOf(HasSubstr("is 2"), HasSubstr("3 planes"), HasSubstr("object[1] of the scene"),
                               HasSubstr("frame 7"), HasSubstr("quadric_processor.caps = 3")));
    EXPECT_EQ(error.diagnostics()[1].key, "object[1]");
    EXPECT_THAT(error.diagnostics()[1].message,
                testing::AllOf(HasSubstr("quadric_processor.caps is too small for"), HasSubstr("frame 7")));
  }
  format.parameters.on_refusal = quadric_processor::OnRefusal::drop;
  QuadricComputation computation(world.resident, format, {{0, 0}, {1, 1}});
  const auto& loads = computation.set_up(work);
  ASSERT_EQ(loads.size(), 1U);
  EXPECT_EQ(loads[0].slot, 1U);
  EXPECT_EQ(loads[0].object, 4U);
  EXPECT_EQ(computation.counts().refused, 1U);
  EXPECT_EQ(computation.counts().drawn, 1U);
}

// Triangles keep the scene's numbers where solids stand among them.
TEST(QuadricComputation, TrianglesAndSolidsAreCountedTogether) {
  SolidWorld world;
  const auto triangle = [](geometry::Mesh& mesh) { add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0}); };
  world.add_solid(false);
  triangle(world.add(true, false));
  world.add_solid(false);
  geometry::Mesh& two = world.add(true, false);
  triangle(two);
  triangle(two);
  world.places = {{{0, 0, -10}, {0, 0, -10}, {0, 0, -10}, {0, 0, -10}}};
  const FrameWork work = Animation(world.resident, false).frame_work(0, true);
  Computation computation(world.resident, format(3), {{0, 0}, {1, 1}, {2, 2}});
  EXPECT_FALSE(computation.survey(work).guarded);
  std::vector<std::uint32_t> objects;
  for (const Load& load : computation.set_up(false, {})) objects.push_back(load.object);
  EXPECT_THAT(objects, testing::ElementsAre(1, 3, 4));
}

TEST(QuadricComputation, ASolidTakesTenNumbersAndFourAPlane) {
  geometry::Solid solid;
  EXPECT_EQ(resident_bytes(solid), 44U);
  solid.planes.resize(2);
  EXPECT_EQ(resident_bytes(solid), 76U);
}

TEST(AssignSolids, RefusesMoreThanThereAre) {
  HostParameters parameters;
  parameters.computation_units = 2;
  EXPECT_EQ(assign_solids(6, parameters, 3).boards[1].size(), 3U);
  try {
    assign_solids(7, parameters, 3);
    FAIL() << "7 solids on 6 processors";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().at(0).key, "quadric_processor.per_unit");
    EXPECT_THAT(error.diagnostics()[0].message,
                testing::AllOf(HasSubstr("7 solids"), HasSubstr("6 quadric processors"), HasSubstr("2 units of 3")));
  }
  EXPECT_EQ(assign_solids(0, parameters, 0).boards.size(), 2U);
  parameters.overflow = Overflow::drop;
  EXPECT_EQ(assign_solids(7, parameters, 3).dropped, 1U);
}

}  // namespace
}  // namespace rastertlm::host
