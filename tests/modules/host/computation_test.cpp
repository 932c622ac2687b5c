// Are a unit's words those of the set-up of every triangle, its report right, and its operations those of the work?
#include "modules/host/computation.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "tests/modules/host/resident_world.h"

namespace rastertlm::host {
namespace {

using set_up::Outcome;

HostParameters machine(std::size_t units, std::uint32_t slots, Assignment assignment) {
  HostParameters parameters;
  parameters.computation_units = static_cast<std::int64_t>(units);
  parameters.processors_per_unit = slots;
  parameters.assignment = assignment;
  return parameters;
}

// Objects that stay within the screen at their place.
void fill_on_screen(World& world, std::mt19937& random) {
  const std::size_t objects = 1 + random() % 3;
  world.places.emplace_back();
  for (std::size_t i = 0; i < objects; ++i) {
    add_random_triangles(world.add(random() % 2 == 0, false), 1 + random() % 12, 1.4, random);
    world.places[0].emplace_back(static_cast<double>(random() % 400) / 100 - 2,
                                 static_cast<double>(random() % 200) / 100 - 1, -10.0);
  }
}

set_up::SetUpResult whole(const PlainTriangle& triangle, const geometry::SnapGrid& grid, const MachineFormat& format) {
  set_up::ScreenTriangle<double> screen;
  for (std::size_t k = 0; k < 3; ++k) screen[k] = geometry::to_screen(triangle.corners[k], format.viewport);
  return set_up::set_up_triangle<double>(screen, triangle.material, triangle.two_sided, grid, format.words);
}

RC_GTEST_PROP(Computation, WordsAreThoseOfEveryTriangleAlone, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  World world;
  fill_on_screen(world, random);
  const std::vector<PlainTriangle> triangles = plain_triangles(world, 0);
  const std::size_t units = 1 + random() % 4;
  const MachineFormat machine_format = format(static_cast<std::uint32_t>(triangles.size()),
                                              *rc::gen::element(set_up::EdgeForm::snapped, set_up::EdgeForm::scaled));
  const SlotMap slots = assign_objects(
      triangles.size(),
      machine(units, machine_format.slots, *rc::gen::element(Assignment::round_robin, Assignment::block)));
  const FrameWork work = Animation(world.resident, false).frame_work(0, true);
  TriangleCounts counts;
  TriangleCounts expected_counts;
  for (const auto& owners : slots.boards) {
    Computation computation(world.resident, machine_format, owners);
    const Survey survey = computation.survey(work);
    RC_ASSERT(!survey.guarded);
    RC_ASSERT(survey.homeless.empty());
    RC_ASSERT(survey.free_slots == machine_format.slots - owners.size());
    std::map<std::uint32_t, Load> by_slot;
    for (const Load& load : computation.set_up(false, {})) RC_ASSERT(by_slot.emplace(load.slot, load).second);
    std::size_t drawn = 0;
    for (const SlotOwner& owner : owners) {
      const set_up::SetUpResult expected =
          whole(triangles[owner.object], machine_format.grids.on_screen, machine_format);
      expected_counts.back_faces += expected.outcome == Outcome::back_face ? 1U : 0U;
      expected_counts.degenerate += expected.outcome == Outcome::degenerate ? 1U : 0U;
      if (expected.outcome != Outcome::drawn) {
        RC_ASSERT(by_slot.count(owner.slot) == 0U);  // it starts parked
        continue;
      }
      ++drawn;
      RC_ASSERT(by_slot.count(owner.slot) == 1U);
      const Load& load = by_slot.at(owner.slot);
      RC_ASSERT(!load.park);
      RC_ASSERT(load.object == owner.object);
      RC_ASSERT((load.words == expected.words));
    }
    RC_ASSERT(by_slot.size() == drawn);
    expected_counts.drawn += drawn;
    counts += computation.triangle_counts();
  }
  RC_ASSERT(counts.drawn == expected_counts.drawn);
  RC_ASSERT(counts.back_faces == expected_counts.back_faces);
  RC_ASSERT(counts.degenerate == expected_counts.degenerate);
  RC_ASSERT(counts.outside + counts.pieces == 0U);
  RC_ASSERT(counts.drawn + counts.back_faces + counts.degenerate == triangles.size());
}

// A triangle given in device coordinates: (x, y) in pixels of the 64 x 48 screen, z 0..1.
glm::dvec3 corner(double x, double y, double z = 0.5) {
  return {(x + 0.5) / (kColumns / 2.0) - 1.0, 1.0 - (y + 0.5) / (kLines / 2.0), z};
}

Survey survey_of(const glm::dvec3& third) {
  World world{glm::dmat4(1.0)};
  add_triangle(world.add(false, false), corner(10, 10), corner(10, 20), third);
  world.places.push_back({glm::dvec3(0.0)});
  Computation computation(world.resident, format(4), {{0, 0}});
  return computation.survey(Animation(world.resident, false).frame_work(0, true));
}

// The samples of the outermost pixels are the last that need no guard band; the fine grid has 2^-q pixel.
TEST(Computation, SurveysWhatNeedsTheGuardBand) {
  const double step = 1.0 / static_cast<double>(1 << format(4).grids.on_screen.fraction_bits);
  EXPECT_FALSE(survey_of(corner(30, 15)).guarded);
  EXPECT_FALSE(survey_of(corner(63, 15)).guarded);
  EXPECT_FALSE(survey_of(corner(63 + 0.49 * step, 15)).guarded);  // is snapped onto the sample
  EXPECT_TRUE(survey_of(corner(63 + 0.51 * step, 15)).guarded);
  EXPECT_TRUE(survey_of(corner(90, 15)).guarded);
  EXPECT_FALSE(survey_of(corner(30, 47)).guarded);
  EXPECT_TRUE(survey_of(corner(30, 47 + 0.51 * step)).guarded);
  EXPECT_FALSE(survey_of(corner(30, 0)).guarded);
  EXPECT_TRUE(survey_of(corner(30, -0.6 * step)).guarded);
  EXPECT_TRUE(survey_of(corner(-0.6 * step, 15)).guarded);
  EXPECT_FALSE(survey_of(corner(30, 15, 0.0)).guarded);
  EXPECT_FALSE(survey_of(corner(30, 15, 1.0)).guarded);
  EXPECT_TRUE(survey_of(corner(30, 15, -0.001)).guarded);
  EXPECT_TRUE(survey_of(corner(30, 15, 1.001)).guarded);
}

// A frame has one grid: where another object needs the guard band, also words of what stands still change.
TEST(Computation, AGridChangeFitsStaticTrianglesAgain) {
  World world{glm::dmat4(1.0)};
  add_triangle(world.add(false, false), corner(10.3, 10.7), corner(12.1, 20.2), corner(25.4, 15.9));
  add_triangle(world.add(false, true), corner(40, 10), corner(40, 20), corner(50, 15));
  const glm::dvec3 inside(0.0);
  const glm::dvec3 off(10.0, 0.0, 0.0);
  world.places = {{inside, inside}, {inside, inside}, {inside, off}, {inside, off}, {inside, inside}};
  const std::vector<bool> guarded{false, false, true, true, false};
  const std::vector<bool> refitted{true, false, true, false, true};
  const MachineFormat machine_format = format(4);
  Computation computation(world.resident, machine_format, {{0, 0}, {1, 1}});
  const Animation animation(world.resident, false);
  for (std::int64_t frame = 0; frame < 5; ++frame) {
    const auto index = static_cast<std::size_t>(frame);
    const FrameWork work = animation.frame_work(frame, frame == 0);
    ASSERT_EQ(computation.survey(work).guarded, guarded[index]) << frame;
    std::vector<Load> of_static;
    std::vector<Load> of_moving;
    for (const Load& load : computation.set_up(guarded[index], {}))
      (load.slot == 0 ? of_static : of_moving).push_back(load);
    EXPECT_EQ(of_static.size(), refitted[index] ? 1U : 0U) << frame;
    const geometry::SnapGrid& grid = guarded[index] ? machine_format.grids.guarded : machine_format.grids.on_screen;
    for (const Load& load : of_static)
      EXPECT_EQ(load.words, whole(plain_triangles(world, frame)[0], grid, machine_format).words) << frame;
    // The other one leaves: parked once, nothing more to say while it is away.
    ASSERT_EQ(of_moving.size(), frame == 3 ? 0U : 1U) << frame;
    if (!of_moving.empty()) {
      EXPECT_EQ(of_moving[0].park, frame == 2) << frame;
    }
    const TriangleCounts counts = computation.triangle_counts();
    EXPECT_EQ(counts.drawn, guarded[index] ? 1U : 2U) << frame;
    EXPECT_EQ(counts.outside, guarded[index] ? 1U : 0U) << frame;
  }
}

TEST(Computation, SendAllWritesAgainWhatDidNotChange) {
  World world{glm::dmat4(1.0)};
  add_triangle(world.add(false, false), corner(10, 10), corner(12, 20), corner(25, 15));
  world.places = {{glm::dvec3(0.0)}, {glm::dvec3(0.0)}};
  for (const bool all : {false, true}) {
    Computation computation(world.resident, format(4), {{0, 2}});
    const Animation animation(world.resident, all);
    const FrameWork first = animation.frame_work(0, true);
    computation.survey(first);
    EXPECT_EQ(computation.set_up(false, {}).size(), 1U);
    const FrameWork second = animation.frame_work(1, false);
    computation.survey(second);
    const std::vector<Load>& loads = computation.set_up(false, {});
    ASSERT_EQ(loads.size(), all ? 1U : 0U);
    if (all) {
      EXPECT_EQ(loads[0].slot, 2U);
    }
  }
}

std::uint64_t flops_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  World world{glm::dmat4(1.0)};
  add_triangle(world.add(false, false), a, b, c);
  world.places.push_back({glm::dvec3(0.0)});
  Computation computation(world.resident, format(4), {{0, 0}});
  const FrameWork work = Animation(world.resident, false).frame_work(0, true);
  computation.survey(work);
  computation.set_up(false, {});
  return computation.operations().flops();
}

// The object's matrix (64 products, 48 sums) and three vertices (21 and 18 each) are paid for in any case; a back face
// needs no edges and no planes.
TEST(Computation, ABackFaceCostsLess) {
  const std::uint64_t front = flops_of(corner(10, 10), corner(10, 20), corner(30, 15));
  const std::uint64_t back = flops_of(corner(10, 10), corner(30, 15), corner(10, 20));
  EXPECT_GT(back, 112U + 3 * 39);
  EXPECT_LT(back + 50, front);
}

TEST(Computation, NothingRenewedCostsNothing) {
  World world{glm::dmat4(1.0)};
  add_triangle(world.add(false, false), corner(10, 10), corner(12, 20), corner(25, 15));
  world.places = {{glm::dvec3(0.0)}, {glm::dvec3(0.0)}};
  Computation computation(world.resident, format(4), {{0, 0}});
  const Animation animation(world.resident, false);
  const FrameWork first = animation.frame_work(0, true);
  computation.survey(first);
  computation.set_up(false, {});
  const geometry::OperationCounts before = computation.operations();
  EXPECT_GT(before.flops(), 0U);
  const FrameWork second = animation.frame_work(1, false);
  computation.survey(second);
  computation.set_up(false, {});
  EXPECT_EQ(computation.operations(), before);
}

// However the triangles are dealt, the work is the same, but that every unit multiplies the matrices of the objects it
// has a triangle of.
RC_GTEST_PROP(Computation, OperationsDoNotDependOnTheAssignment, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  World world;
  fill_on_screen(world, random);
  // Some of them need the guard band.
  world.places[0][0].x += static_cast<double>(random() % 5);
  const FrameWork work = Animation(world.resident, false).frame_work(0, true);
  const std::size_t count = world.triangles();
  std::vector<geometry::OperationCounts> sums;
  for (const Assignment assignment : {Assignment::round_robin, Assignment::block}) {
    const std::size_t units = 1 + random() % 5;
    const auto slots = static_cast<std::uint32_t>(count * 8);
    const auto dealt =
        static_cast<std::uint32_t>(assignment == Assignment::block ? (count + units - 1) / units : slots);
    const SlotMap map = assign_objects(count, machine(units, dealt, assignment));
    geometry::OperationCounts& sum = sums.emplace_back();
    std::vector<Computation> computations;
    bool guarded = false;
    for (const auto& owners : map.boards) {
      computations.emplace_back(world.resident, format(slots), owners);
      guarded = computations.back().survey(work).guarded || guarded;
    }
    for (std::size_t unit = 0; unit < computations.size(); ++unit) {
      computations[unit].set_up(guarded, {});
      sum += computations[unit].operations();
      std::size_t first = 0;
      for (const geometry::Mesh& mesh : world.meshes) {
        bool owns = false;
        for (const SlotOwner& owner : map.boards[unit])
          owns = owns || (owner.object >= first && owner.object < first + mesh.triangles.size());
        first += mesh.triangles.size();
        sum.multiply -= owns ? 64U : 0U;
        sum.add -= owns ? 48U : 0U;
      }
    }
  }
  RC_ASSERT((sums[0] == sums[1]));
}

Piece piece(std::uint32_t object) {
  Piece result;
  result.object = object;
  return result;
}

TEST(PlacePieces, FillsBoardsInOrderAndKeepsTheRest) {
  std::vector<Piece> homeless{piece(10), piece(11), piece(12), piece(13), piece(14)};
  const auto placed = place_pieces(homeless, {0, 2, 0, 1});
  ASSERT_EQ(placed.size(), 4U);
  EXPECT_TRUE(placed[0].empty());
  ASSERT_EQ(placed[1].size(), 2U);
  EXPECT_EQ(placed[1][0].object, 10U);
  EXPECT_EQ(placed[1][1].object, 11U);
  EXPECT_TRUE(placed[2].empty());
  ASSERT_EQ(placed[3].size(), 1U);
  EXPECT_EQ(placed[3][0].object, 12U);
  ASSERT_EQ(homeless.size(), 2U);
  EXPECT_EQ(homeless[0].object, 13U);
  EXPECT_EQ(homeless[1].object, 14U);
}

TEST(PlacePieces, NothingToPlace) {
  std::vector<Piece> homeless;
  EXPECT_EQ(place_pieces(homeless, {3, 3}).size(), 2U);
  EXPECT_TRUE(homeless.empty());
}

}  // namespace
}  // namespace rastertlm::host
