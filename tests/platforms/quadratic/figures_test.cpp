// Does the report say of triangles, bus words and memories what the machine did and has?
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "src/run/quadratic_figures.h"
#include "tests/platforms/quadratic/screens.h"
#include "tests/support/forked.h"

namespace rastertlm::test {
namespace {

constexpr double kSide = 64;

host::SetUpCounts counts_of(const quadratic::Machine& machine, const scene::Scene& scene) {
  quadratic::Quadratic platform(machine, scene, {1, false}, {});
  platform.run();
  return platform.frames().front().set_up.counts;
}

void turn_last(scene::Scene& scene) {
  auto& last = scene.objects[0].mesh.triangles.back();
  std::swap(last[1], last[2]);
}

// Triangles that reach over the band around the screen are cut, and are still one triangle each.
TEST(Triangles, CountOnceByAllOfTheirPieces) {
  scene::Scene scene = screen_scene(kSide);
  const auto add = [&](ScreenPoint a, ScreenPoint b, ScreenPoint c) { add_triangle(scene, kSide, kSide, a, b, c); };
  add({10, 10}, {30, 10}, {10, 30});
  add({-300, 30}, {330, -300}, {330, 330});
  turn_last(scene);
  add({-300, 31}, {330, -300}, {330, 330});
  add({500, 10}, {600, 10}, {500, 90});
  add({20.01, 20.01}, {20.02, 20.01}, {20.01, 20.02});
  const host::SetUpCounts counts = counts_of(span_unit_alone(64, 64), scene);
  EXPECT_GT(counts.colour.back_faces, 1U);  // pieces
  EXPECT_GT(counts.colour.drawn, 2U);
  EXPECT_EQ(counts.triangles, 5U);
  EXPECT_EQ(counts.facing, 2U);
  EXPECT_EQ(counts.back_faces, 1U);
  EXPECT_EQ(counts.outside, 1U);
  EXPECT_EQ(counts.degenerate, 1U);
  EXPECT_EQ(counts.pieces, counts.colour.drawn + counts.colour.back_faces - 3);
}

// Two loads of one half: 2 words of lines (7 bits), 4 of columns (9), 6 of rests (3 x 64 x 2^8: 16), 18 of colours and
// 3 of depth (24.8).
TEST(Bus, CarriesEachWordAsWideAsItsRegister) {
  scene::Scene scene = screen_scene(kSide);
  add_rectangle(scene, kSide, kSide, 0, kSide);
  const auto expect = [&](std::int64_t word_bits, std::int64_t bus_bits, bool adaptive, std::uint64_t bus_words) {
    const std::string counted = in_child([&] {
      quadratic::Machine machine = span_unit_alone(64, 64);
      machine.span_unit.word_bits = word_bits;
      machine.span_unit.fraction_bits = word_bits - 10;
      machine.host.bus_bits = bus_bits;
      if (adaptive) {
        machine.set_up.method = ShadingMethod::quadratic_adaptive;
        machine.set_up.snap_bits = 8;
        machine.set_up.test_depth_limit = 6;
      }
      quadratic::Quadratic platform(machine, scene, {1, false}, {});
      platform.run();
      return fmt::format("{} sent, {} on the bus, {} cycles", platform.set_up_processor().words_sent(),
                         platform.links().front().words(), platform.frames().front().set_up.writing.count());
    });
    EXPECT_EQ(counted, fmt::format("{} sent, {} on the bus, {} cycles", 2 * 33, 2 * bus_words, 2 * bus_words));
  };
  expect(32, 32, false, 33);
  expect(12, 16, false, 2 + 4 + 6 + 18 + 2 * 3);
  expect(12, 8, false, 2 + 2 * 4 + 2 * 6 + 2 * 18 + 4 * 3);
  // Corners in 2^-14 pixel: 3 x 64 x 2^28, 36 bits.
  expect(32, 32, true, 2 + 4 + 2 * 6 + 18 + 3);
  expect(32, 16, true, 2 + 4 + 3 * 6 + 2 * 18 + 2 * 3);
}

std::uint64_t bits_a_pixel(const std::vector<run::Memory>& memories, std::uint64_t buffers) {
  std::uint64_t bits = 0;
  for (const run::Memory& memory : memories) {
    if (!memory.name.starts_with("frame store")) continue;
    EXPECT_EQ(memory.instances, buffers) << memory.name;
    EXPECT_EQ(memory.words, 512U * 512) << memory.name;
    bits += memory.bits_per_word;
  }
  return bits;
}

// A word that holds what the rows say of a pixel holds the pixel: it is written in one access, and in two where it is a
// bit narrower.
TEST(Memories, AreWhatIsAccessed) {
  for (const std::int64_t buffers : {1, 2})
    for (const bool depth_test : {true, false})
      for (const bool dealt : {false, true}) {
        quadratic::Machine machine;
        machine.frame_store.buffers = buffers;
        machine.frame_store.depth_test = depth_test;
        machine.span_unit.units = 4;
        machine.span_unit.share = dealt ? span_unit::Share::triangles : span_unit::Share::columns;
        const std::uint64_t bits = bits_a_pixel(run::memory_figures(machine), static_cast<std::uint64_t>(buffers));
        EXPECT_EQ(bits, 24U + (depth_test ? 24U + (dealt ? 24U : 0U) : 0U));
        machine.frame_store.width_bits = static_cast<std::int64_t>(bits);
        EXPECT_EQ(machine.layout().write_words, 1U);
        EXPECT_EQ(machine.layout().pixels_a_word, 1U);
        machine.frame_store.width_bits = static_cast<std::int64_t>(2 * bits);
        EXPECT_EQ(machine.layout().pixels_a_word, 2U);
        machine.frame_store.width_bits = static_cast<std::int64_t>(bits) - 1;
        EXPECT_EQ(machine.layout().write_words, 2U);
      }
}

}  // namespace
}  // namespace rastertlm::test
