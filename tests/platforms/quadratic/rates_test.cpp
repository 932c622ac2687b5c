// Does the machine draw as fast as the closed forms say, and which parameter would alone give the paper's rate?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/host/cost_model.h"
#include "tests/platforms/quadratic/screens.h"
#include "tests/support/forked.h"

namespace rastertlm::test {
namespace {

double frames_per_second(const quadratic::Machine& machine, const scene::Scene& scene, std::uint64_t frames = 4) {
  quadratic::Quadratic platform(machine, scene, {frames, false}, {});
  platform.run();
  return platform.frames_per_second();
}

// Nothing clears the two buffers: their first pictures are seen whole, later ones are hidden by what stands there.
constexpr std::uint64_t kSeenWhole = 2;
constexpr double kThousand = 1000;

scene::Scene thousand_screen() {
  scene::Scene scene = screen_scene(kThousand);
  add_rectangle(scene, kThousand, kThousand, 0, kThousand);
  return scene;
}

// 000/001, section 7, has 50 ns and 1000 x 1000 and concludes 16 frames a second: it is 20 (a million pixels take 50
// ms, the first load 50 ns).
TEST(Rates, AThousandByAThousandAt50NsIsTwentyFrames) {
  const scene::Scene scene = thousand_screen();
  EXPECT_NEAR(frames_per_second(span_unit_alone(1000, 1000), scene), 20.0, 0.001);
}

// 62.5 ms, a quarter more than the pixels take. Lines change 1998 times within the two triangles.
TEST(Rates, SixteenByLineChanges) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.span_unit.line_change_cycles = 125;
  EXPECT_NEAR(frames_per_second(machine, scene), 16.0, 0.02);
}

TEST(Rates, SixteenByLoads) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.span_unit.load_cycles = 10'000;  // of each of 25 triangles: 25 x 10,000 x 50 ns is 12.5 ms
  machine.span_unit.shadow_sets = 0;       // nothing is loaded while something is drawn
  scene::Scene strips = screen_scene(kThousand);
  for (int strip = 0; strip < 12; ++strip)
    add_rectangle(strips, kThousand, kThousand, std::floor(strip * kThousand / 12),
                  std::floor((strip + 1) * kThousand / 12));
  add_triangle(strips, kThousand, kThousand, {3, 3}, {3.4, 3}, {3, 3.4});
  EXPECT_NEAR(frames_per_second(machine, strips), 16.0, 0.02);
}

TEST(Rates, SixteenByDepthComplexity) {
  scene::Scene scene = thousand_screen();
  add_rectangle(scene, kThousand, kThousand, 0, 250, 5.0);
  EXPECT_NEAR(frames_per_second(span_unit_alone(1000, 1000), scene), 16.0, 0.02);
}

// A pixel's word is read and written: two accesses of 31.25 ns.
TEST(Rates, SixteenByTheMemory) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.frame_store.access_ns = 31.25;
  EXPECT_NEAR(frames_per_second(machine, scene, kSeenWhole), 16.0, 0.02);
}

// 20 ms are 400,000 pixels of 50 ns, 1.5259 screens of 512 x 512: a screen and 269 of its lines (1.5254) fit, with 270
// (1.5273) every second retrace is missed.
double rate_with_lines(double lines) {
  scene::Scene scene = screen_scene(512);
  add_rectangle(scene, 512, 512, 0, 512);
  add_rectangle(scene, 512, 512, 0, lines, 5.0);
  quadratic::Machine machine = span_unit_alone(512, 512);
  machine.video.pixel_clock_ns = 60.0;
  machine.video.vertical_retrace_us = 600.0;
  machine.frame_store.swap = frame_store::Swap::retrace;
  return frames_per_second(machine, scene);
}
TEST(Rates, FiftyFramesUpToADepthComplexityOf1525) { EXPECT_NEAR(rate_with_lines(269), 50.0, 0.001); }
TEST(Rates, AndNotBeyond) { EXPECT_NEAR(rate_with_lines(270), 25.0, 0.001); }

// Two units that share the columns halve the time of a line, but for odd ones.
TEST(Rates, TwoUnitsDrawTwiceAsFast) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.span_unit.units = 2;
  EXPECT_NEAR(frames_per_second(machine, scene), 40.0, 0.05);
}

// With a clear, which writes every word once: 5 ms more at 5 ns.
TEST(Rates, ClearingTakesItsWrites) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.frame_store.access_ns = 5.0;
  machine.frame_store.clear = true;
  EXPECT_NEAR(frames_per_second(machine, scene), 1e3 / 55.0, 0.01);
}

// The set-up processor and span units, to which triangles are dealt, as two stages with `sets` places between them:
// what each triangle's set-up, writing and drawing take, in picoseconds.
struct Work {
  std::uint64_t computing, writing, drawing;
};

constexpr std::uint64_t kLoad = 50'000;  // from written registers to the first pixel

std::uint64_t drawn_by(const std::vector<Work>& work, std::size_t sets, std::size_t units) {
  std::vector<std::uint64_t> start(work.size()), end(work.size());
  std::uint64_t processor = 0;
  for (std::size_t i = 0; i < work.size(); ++i) {
    processor += work[i].computing;
    std::uint64_t set_free = 0;
    if (sets == 0 && i >= units) set_free = end[i - units];
    if (sets > 0 && i >= sets * units) set_free = start[i - sets * units];
    processor = std::max(processor, set_free) + work[i].writing;
    start[i] = std::max(processor + kLoad, i >= units ? end[i - units] : 0);
    end[i] = start[i] + work[i].drawing;
  }
  return *std::max_element(end.begin(), end.end());
}

class Overlap : public testing::TestWithParam<std::pair<std::int64_t, std::int64_t>> {};  // shadow sets, units

// All clocks are 50 ns, so that nobody waits for an edge.
TEST_P(Overlap, OfSetUpAndDrawingIsTheClosedForm) {
  constexpr double kSide = 256;
  std::mt19937_64 random(4);
  const auto at = [&] { return std::uniform_real_distribution<double>(0, kSide - 1)(random); };
  scene::Scene scene = screen_scene(kSide);
  for (int i = 0; i < 60; ++i) add_triangle(scene, kSide, kSide, {at(), at()}, {at(), at()}, {at(), at()});
  quadratic::Machine machine = span_unit_alone(256, 256);
  machine.host.clock_hz = 20'000'000;
  machine.host.sustained_mflops = 8.0;
  machine.host.bus_cycles_per_word = 20;
  const auto [sets, units] = GetParam();
  machine.span_unit.shadow_sets = sets;
  machine.span_unit.units = units;
  machine.span_unit.share = span_unit::Share::triangles;
  quadratic::Quadratic platform(machine, scene, {1, false}, {});

  host::ResidentScene resident;
  resident.objects.push_back({&scene.objects[0].mesh, false, false});
  host::SetUpWork set_up(resident, machine.set_up, machine.set_up_format(),
                         {{glm::dvec3(0.05), glm::dvec3(0.25), glm::dvec3(0.4), 20}}, {});
  set_up.begin_frame(scene::pose(scene, 0, 256, 256), false);
  span_unit::SpanUnit unit(machine.span_unit, 256, 256);
  std::vector<Work> work;
  constexpr std::uint64_t kClock = 50'000;
  std::uint64_t computing = 0;
  while (set_up.next()) {
    computing += kClock * platform.cost().compute(set_up.operations()).count();
    for (const auto& load : set_up.loads()) {
      const std::uint64_t cycles = unit.draw(load).cycles;
      const std::uint64_t words =
          rastertlm::set_up::bus_words(set_up.words_of(load), set_up.widths(), platform.cost().bus_bits());
      work.push_back({computing, kClock * platform.cost().bus_transfer(words).count(), kClock * cycles});
      computing = 0;
    }
  }
  ASSERT_GT(work.size(), 50U);
  platform.run();
  EXPECT_EQ(platform.span_unit().end_ps(),
            drawn_by(work, static_cast<std::size_t>(sets), static_cast<std::size_t>(units)));
}

INSTANTIATE_TEST_SUITE_P(ShadowSets, Overlap,
                         testing::Values(std::pair(0, 1), std::pair(1, 1), std::pair(2, 1), std::pair(5, 1),
                                         std::pair(0, 2), std::pair(1, 2), std::pair(3, 2), std::pair(1, 5)));

// Whoever draws, and in whatever order: the nearest stays, and of equal depths the lower number.
TEST(DealtUnits, ShowWhatOneUnitShows) {
  constexpr double kSide = 128;
  std::mt19937_64 random(8);
  const auto at = [&] { return std::uniform_real_distribution<double>(0, kSide - 1)(random); };
  scene::Scene scene = screen_scene(kSide);
  for (int i = 0; i < 80; ++i)
    add_triangle(scene, kSide, kSide, {at(), at()}, {at(), at()}, {at(), at()}, static_cast<double>(random() % 3));
  const auto shown = [&](std::int64_t units) {
    return in_child([&] {
      quadratic::Machine machine = span_unit_alone(128, 128);
      machine.span_unit.units = units;
      machine.span_unit.share = span_unit::Share::triangles;
      machine.frame_store.access_ns = 40.0;
      machine.frame_store.swap = frame_store::Swap::retrace;  // whole, whenever that is
      std::string bytes;
      quadratic::Quadratic platform(machine, scene, {1, true}, [&](const auto&, const frame::Frame& frame) {
        bytes.assign(frame.rgb.begin(), frame.rgb.end());
        for (const auto* plane : {&frame.object, &frame.depth, &frame.coverage})
          for (const std::uint32_t word : *plane) bytes += std::to_string(word) + ' ';
      });
      platform.run();
      return bytes;
    });
  };
  const std::string one = shown(1);
  EXPECT_TRUE(one == shown(2));
  EXPECT_TRUE(one == shown(7));
}

// Two units of 50 ns a pixel ask for more than one memory gives: they are as fast as that.
TEST(DealtUnits, ShareTheMemory) {
  const scene::Scene scene = thousand_screen();
  quadratic::Machine machine = span_unit_alone(1000, 1000);
  machine.span_unit.units = 2;
  machine.span_unit.share = span_unit::Share::triangles;
  machine.frame_store.access_ns = 20.0;
  machine.frame_store.width_bits = 128;  // depth, colour and number: a read and a write, 40 ns a pixel
  EXPECT_NEAR(frames_per_second(machine, scene, kSeenWhole), 25.0, 0.1);
}

}  // namespace
}  // namespace rastertlm::test
