// Are the words of plain numbers, and the operations counted by path, those of Counted numbers, triangle by triangle?
#include "modules/host/path_counts.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "modules/host/computation.h"
#include "tests/modules/host/resident_world.h"

namespace rastertlm::host {
namespace {

using Number = geometry::Counted<double>;
using geometry::operation_counts;
using geometry::OperationCounts;

// A unit's frame, in Counted numbers from beginning to end.
struct Counted {
  OperationCounts operations;
  std::vector<object_processor::TriangleWords> words;  // drawn, of every triangle in turn
};

Counted counted(const World& world, const MachineFormat& format, bool guarded) {
  const OperationCounts before = operation_counts;
  Counted result;
  const geometry::Pose pose = world.pose(0);
  const geometry::FrameGrid band = geometry::frame_grid(format.grids, true, format.viewport);
  const geometry::SnapGrid& grid = guarded ? format.grids.guarded : format.grids.on_screen;
  const auto keep = [&](const set_up::SetUpResult& fitted) {
    if (fitted.outcome == set_up::Outcome::drawn) result.words.push_back(fitted.words);
  };
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    const geometry::Mesh& mesh = world.meshes[i];
    const bool two_sided = world.resident.objects[i].two_sided;
    const glm::dmat4 matrix = matrix_product<Number>(pose.eye_to_clip, pose.object_to_eye[i]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      geometry::ClipTriangle<Number> corners;
      set_up::ScreenTriangle<Number> screen{};
      bool needs_guard = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.triangles[t][k];
        corners[k] = set_up::transform_vertex<Number>(mesh.positions[corner], mesh.normals[corner], matrix,
                                                      pose.normal_to_eye[i]);
        if (needs_guard) continue;
        needs_guard = !geometry::within_depth(corners[k]);
        if (needs_guard) continue;
        screen[k] = geometry::to_screen(corners[k], format.viewport);
        needs_guard = !geometry::within_samples(screen[k], format.grids.on_screen, format.viewport);
      }
      if (needs_guard) {
        const auto pieces = set_up::pieces(corners, band, format.viewport);
        for (const auto& piece : pieces.list())
          keep(set_up::set_up_triangle(piece, mesh.material[t], two_sided, band.grid, format.words));
      } else {
        keep(set_up::set_up_triangle(screen, mesh.material[t], two_sided, grid, format.words));
      }
    }
  }
  result.operations = operation_counts - before;
  return result;
}

bool by_words(const object_processor::TriangleWords& a, const object_processor::TriangleWords& b) {
  return object_processor::to_words(a) < object_processor::to_words(b);
}

RC_GTEST_PROP(PathCounts, PlainNumbersGiveTheWordsAndOperationsOfCountedOnes, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  World world;
  world.places.emplace_back();
  const std::size_t objects = 1 + random() % 3;
  const bool clipped = random() % 2 == 0;
  for (std::size_t i = 0; i < objects; ++i) {
    geometry::Mesh& mesh = world.add(random() % 2 == 0, false);
    add_random_triangles(mesh, 1 + random() % 12, random() % 4 == 0 ? 0.02 : 1.4, random);
    if (random() % 3 == 0) add_triangle(mesh, glm::dvec3(0.1), glm::dvec3(0.1), glm::dvec3(0.2));  // no area
    world.places[0].emplace_back(static_cast<double>(random() % 400) / 100 - 2 + (clipped ? 3.5 : 0.0),
                                 static_cast<double>(random() % 200) / 100 - 1, -10.0);
  }
  const auto count = static_cast<std::uint32_t>(world.triangles());
  const MachineFormat machine =
      format(8 * count, *rc::gen::element(set_up::EdgeForm::snapped, set_up::EdgeForm::scaled));
  std::vector<SlotOwner> owners;
  for (std::uint32_t object = 0; object < count; ++object) owners.push_back({object, object});
  Computation computation(world.resident, machine, owners);
  const FrameWork work = Animation(world.resident, false).frame_work(0, true);
  const bool guarded = computation.survey(work).guarded;
  std::vector<object_processor::TriangleWords> words;
  for (const Load& load : computation.set_up(guarded, {}))
    if (!load.park) words.push_back(load.words);
  Counted expected = counted(world, machine, guarded);
  std::sort(words.begin(), words.end(), by_words);
  std::sort(expected.words.begin(), expected.words.end(), by_words);
  RC_ASSERT((words == expected.words));
  RC_ASSERT((computation.operations() == expected.operations));
}

// 64 products and 48 sums; three vertices of 21 and 18, brought to the screen and compared.
TEST(PathCounts, AreThoseOfTheFormulas) {
  const PathCounts counts = count_paths();
  EXPECT_EQ(counts.matrix.multiply, 64U);
  EXPECT_EQ(counts.matrix.add, 48U);
  EXPECT_EQ(counts.matrix.flops(), 112U);
  EXPECT_EQ(counts.three_inside.multiply, 3U * (21 + 5 + 2));  // transformed, to the screen, snapped
  EXPECT_EQ(counts.three_inside.divide, 3U);
  EXPECT_EQ(counts.three_inside.compare, 3U * (2 + 4));
  EXPECT_EQ(counts.three_inside.convert, 3U * 2);
  EXPECT_EQ(counts.drawn.divide, 1U);
  EXPECT_EQ(counts.back_face.convert, 6U);  // six snapped coordinates
  EXPECT_EQ(counts.back_face, counts.degenerate);
  EXPECT_LT(counts.back_face.flops() + 50, counts.drawn.flops());
}

}  // namespace
}  // namespace rastertlm::host
