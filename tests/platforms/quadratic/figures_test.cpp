// Does the report say of triangles, bus words, memories and links what the machine did and has? And what does it do
// with triangles that no machine likes?
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "src/run/quadratic_figures.h"
#include "tests/platforms/quadratic/screens.h"
#include "tests/platforms/quadratic/sphere_frames.h"
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

// Bytes that crossed each link and its width; and where they are more than it carries.
std::string links_of(const quadratic::Machine& machine, const scene::Scene& scene, std::uint64_t frames) {
  return in_child([&] {
    quadratic::Quadratic platform(machine, scene, {frames, false}, {});
    platform.run();
    std::string all;
    for (const run::LinkFigures& link : run::link_figures(platform)) {
      all += fmt::format("{} bytes by {} bits; ", link.bytes, link.bits);
      if (link.utilisation > 1.0 || link.active_bytes_per_s > link.peak_bytes_per_s * (1 + 1e-9))
        all += fmt::format("{} is too much; ", link.utilisation);
    }
    return all;
  });
}

// Many units, whose pixels cross side by side, and frames that are whole long before the screen has shown one: 32
// strips of two triangles with 33 words, 4,096 pixels, four times. One unit draws for 0.8 ms, in which two of 64 lines
// of a screen of 20 ms pass; more of them are done before its first line.
TEST(Links, CarryNoMoreThanTheyCan) {
  scene::Scene scene = screen_scene(kSide);
  for (int strip = 0; strip < 32; ++strip) add_rectangle(scene, kSide, kSide, 2 * strip, 2 * strip + 2);
  quadratic::Machine machine = span_unit_alone(64, 64);
  const std::string bus = fmt::format("{} bytes by 32 bits; ", 4 * 64 * 33 * 4);
  EXPECT_EQ(links_of(machine, scene, 4), bus + fmt::format("{} bytes by 48 bits; ", 4 * 4096 * 6) +
                                             fmt::format("{} bytes by 24 bits; ", 2 * 64 * 3));
  machine.span_unit.units = 64;
  EXPECT_EQ(links_of(machine, scene, 4),
            bus + fmt::format("{} bytes by {} bits; 0 bytes by 24 bits; ", 4 * 4096 * 6, 64 * 48));
  machine.span_unit.share = span_unit::Share::triangles;
  EXPECT_EQ(links_of(machine, scene, 4),
            bus + fmt::format("{} bytes by {} bits; 0 bytes by 24 bits; ", 4 * 4096 * 9, 64 * 72));
  machine.span_unit.pixel_cycles = 3;
  EXPECT_EQ(links_of(machine, scene, 4),
            bus + fmt::format("{} bytes by {} bits; 0 bytes by 24 bits; ", 4 * 4096 * 9, 64 * 72));
}

struct Shown {
  host::SetUpCounts counts;
  frame::Frame pixels;
};

Shown shown_by(const quadratic::Machine& machine, const scene::Scene& scene) {
  Shown shown;
  quadratic::Quadratic platform(machine, scene, {1, true},
                                [&](const quadratic::ShownFrame& frame, const frame::Frame& pixels) {
                                  shown.counts = frame.set_up.counts;
                                  shown.pixels = pixels;
                                });
  platform.run();
  return shown;
}

quadratic::Machine on_256ths(std::int64_t side) {
  quadratic::Machine machine = span_unit_alone(side, side);
  machine.set_up.snap_bits = 8;
  machine.frame_store.swap = frame_store::Swap::retrace;  // what is seen is whole
  return machine;
}

std::string covered(const scene::Scene& scene) {
  return in_child([&] {
    const Shown shown = shown_by(on_256ths(64), scene);
    std::string text = fmt::format("facing {}, flat {}, loads {}:", shown.counts.facing, shown.counts.colour.flat_low,
                                   shown.counts.loads);
    for (std::size_t pixel = 0; pixel < shown.pixels.coverage.size(); ++pixel)
      if (shown.pixels.coverage[pixel] > 0) text += fmt::format(" {},{}", pixel % 64, pixel / 64);
    return text;
  });
}

// Smaller than a pixel: drawn where it holds a sample, and nowhere else; it is no zero area.
TEST(HardTriangles, OfLessThanAPixelShowTheSampleThatTheyHold) {
  scene::Scene scene = screen_scene(kSide);
  add_triangle(scene, kSide, kSide, {20.25, 20.25}, {20.75, 20.25}, {20.25, 20.75});
  EXPECT_EQ(covered(scene), "facing 1, flat 0, loads 0:");
  add_triangle(scene, kSide, kSide, {30.75, 39.75}, {31.25, 39.75}, {30.75, 40.5});
  EXPECT_EQ(covered(scene), "facing 2, flat 0, loads 1: 31,40");
}

// Lower than 1/64 pixel there are no slopes: in one colour, on the samples of its top edge. At 1/64 there are.
TEST(HardTriangles, LowerThanASixtyFourthAreFlat) {
  const auto low = [](double steps) {
    scene::Scene scene = screen_scene(kSide);
    add_triangle(scene, kSide, kSide, {10, 20}, {14, 20}, {12, 20 + steps / 256});
    return covered(scene);
  };
  EXPECT_EQ(low(1), "facing 1, flat 1, loads 1: 10,20 11,20 12,20 13,20");
  EXPECT_EQ(low(3), "facing 1, flat 1, loads 1: 10,20 11,20 12,20 13,20");
  EXPECT_EQ(low(4), "facing 1, flat 0, loads 1: 10,20 11,20 12,20 13,20");
}

// Where every triangle is too far off, all are split to the limit, and those there are counted.
TEST(HardTriangles, AreSplitToTheLimitAndCountedThere) {
  scene::Scene scene = screen_scene(kSide);
  add_triangle(scene, kSide, kSide, {5, 5}, {60, 8}, {9, 57});
  scene.objects[0].mesh.normals = {glm::normalize(glm::dvec3(-1, 1, 1)), glm::normalize(glm::dvec3(1, 1, 1)),
                                   glm::normalize(glm::dvec3(0, -1, 1))};
  for (const std::int64_t limit : {0, 1, 3}) {
    const std::string counted = in_child([&] {
      quadratic::Machine machine = on_256ths(64);
      machine.set_up.method = ShadingMethod::quadratic_adaptive;
      machine.set_up.test_threshold_levels = 0.0;
      machine.set_up.test_depth_limit = limit;
      const set_up::ColourCounts counts = shown_by(machine, scene).counts.colour;
      return fmt::format("{} split, {} at the limit, {} drawn", counts.splits, counts.at_limit, counts.drawn);
    });
    const std::int64_t leaves = std::int64_t{1} << 2 * limit;
    EXPECT_EQ(counted, fmt::format("{} split, {} at the limit, {} drawn", (leaves - 1) / 3, leaves, leaves));
  }
}

struct GridPoint {
  std::int64_t x, y;
};

// Whether a sample lies within a triangle, in steps of the grid: exactly. On an edge it belongs to the triangle to the
// right of it, or, where it is level, below.
bool holds(std::array<GridPoint, 3> corners, GridPoint sample) {
  const auto cross = [](const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  };
  if (cross(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
  for (std::size_t i = 0; i < 3; ++i) {  // clockwise as seen, y down: inside is to the right of each edge
    const GridPoint &a = corners[i], &b = corners[(i + 1) % 3];
    const std::int64_t side = cross(a, b, sample);
    const bool left_or_top = b.y < a.y || (b.y == a.y && b.x > a.x);
    if (side < 0 || (side == 0 && !left_or_top)) return false;
  }
  return true;
}

// 2,000 pixels long, and less than 2/1000 wide: along diagonals through the samples, a step of the grid off.
TEST(HardTriangles, SliversShowExactlyTheSamplesThatTheyHold) {
  constexpr std::int64_t kOne = 256;
  constexpr std::int64_t kColumns = 512;
  std::mt19937_64 random(5);
  std::vector<std::array<GridPoint, 3>> slivers;
  for (int i = 0; i < 40; ++i) {
    const auto step = [&] { return static_cast<std::int64_t>(random() % 3) - 1; };
    const auto off = [&] { return static_cast<std::int64_t>(random() % 30) * kOne; };
    const std::int64_t down = i % 2 == 0 ? 1 : -1;
    const std::int64_t left = -490 * kOne + off();
    const std::int64_t top = (i % 2 == 0 ? -490 : 1000) * kOne + down * off();
    const std::int64_t half = 740 * kOne;
    slivers.push_back({GridPoint{left, top}, GridPoint{left + half + step(), top + down * half},
                       GridPoint{left + 2 * half, top + down * (2 * half + 1)}});
  }
  scene::Scene scene = screen_scene(kColumns);
  for (const auto& [a, b, c] : slivers) {
    const auto pixels = [](const GridPoint& p) {
      return ScreenPoint{static_cast<double>(p.x) / kOne, static_cast<double>(p.y) / kOne};
    };
    add_triangle(scene, kColumns, kColumns, pixels(a), pixels(b), pixels(c));
  }
  const Shown shown = shown_by(on_256ths(kColumns), scene);
  EXPECT_EQ(shown.counts.facing, slivers.size());
  std::size_t samples = 0;
  for (std::int64_t line = 0; line < kColumns; ++line)
    for (std::int64_t column = 0; column < kColumns; ++column) {
      const auto count = static_cast<std::uint32_t>(std::count_if(slivers.begin(), slivers.end(), [&](const auto& s) {
        return holds(s, {column * kOne, line * kOne});
      }));
      ASSERT_EQ(shown.pixels.coverage[static_cast<std::size_t>(line * kColumns + column)], count)
          << column << ", " << line;
      samples += count;
    }
  EXPECT_GT(samples, 1000U);
}

// Which pixels are covered how often, and by which triangle, of a sphere that is split where its highlight is.
std::string coverage_of(const std::vector<std::string>& settings) {
  return in_child([&] {
    const run::Inputs inputs = sphere_inputs("168", settings);
    const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
    const Shown shown = shown_by(machine, *inputs.content->scene);
    std::string text = shown.counts.colour.splits > 0 ? "split" : "whole";
    for (std::size_t pixel = 0; pixel < shown.pixels.object.size(); ++pixel)
      text += fmt::format(" {}*{}", shown.pixels.coverage[pixel], shown.pixels.object[pixel]);
    return text;
  });
}

// Of a closed mesh's front every pixel is covered once; split triangles leave neither hole nor double pixel. Corners of
// parts that are moved to a grid of whole pixels would.
TEST(SplitTriangles, CoverWhatTheirParentsDo) {
  const std::vector<std::string> usual{"video.columns=256", "video.lines=256", "material[0].exponent=50",
                                       "set_up.snap_bits=0"};
  const auto with = [&](std::vector<std::string> settings) {
    settings.insert(settings.begin(), usual.begin(), usual.end());
    return coverage_of(settings);
  };
  const std::string whole = with({"set_up.method=quadratic"});
  const std::string split = with({"set_up.method=quadratic_adaptive", "highlight_test.threshold_levels=1.0"});
  const std::string moved =
      with({"set_up.method=quadratic_adaptive", "highlight_test.threshold_levels=1.0", "subdivision.coverage=snapped"});
  ASSERT_TRUE(whole.starts_with("whole"));
  ASSERT_TRUE(split.starts_with("split"));
  EXPECT_EQ(whole.find(" 2*"), std::string::npos);
  EXPECT_TRUE(whole.substr(5) == split.substr(5));
  EXPECT_FALSE(whole.substr(5) == moved.substr(5));
}

}  // namespace
}  // namespace rastertlm::test
