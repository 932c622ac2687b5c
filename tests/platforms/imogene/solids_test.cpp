// Solids of all kinds in the whole machine, against the exact renderer: random scenes, several poses, both projections.
// Every pixel shows something that it may show by the bounds of rounding (exact_solids.h), at a depth that is within
// them; what the exact renderer shows, wherever nothing else is that near; and a normal that is no further from the
// surface's own than root, constants and link words allow.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/platforms/imogene/exact_solids.h"
#include "tests/platforms/imogene/simulation.h"
#include "tests/platforms/imogene/solid_scenes.h"

namespace rastertlm::test {
namespace {

using quadric_processor::QuadricPixel;
using quadric_processor::Surface;
using View = SolidScene::View;

struct Figures {
  std::uint64_t pixels = 0, of_solids = 0;
  std::uint64_t excused = 0;     // more than one thing may be seen there
  std::uint64_t ties = 0;        // several solids are cut by the near plane there
  std::uint64_t other_face = 0;  // the solid is entered by another of its surfaces, of the same depth within bounds
  std::uint64_t normals = 0, no_bound = 0;
  std::uint64_t deep = 0;             // by more than a sphere of 24 bits may be
  double depth = 0, depth_bound = 0;  // the largest, in units of depth
  double angle = 0, of_bound = 0;     // radians; of the pixel's bound
  std::array<std::uint64_t, 4> surfaces{};
  std::uint64_t by_triangles = 0;
  std::uint64_t wrong = 0;
  std::string first_wrong;

  void note(const std::string& what, std::size_t x, std::size_t y) {
    if (wrong++ == 0) first_wrong = fmt::format("{} at {}, {}", what, x, y);
  }
};

bool same_surface(const QuadricPixel& pixel, const geometry::QuadricHit& hit) {
  using Exact = geometry::QuadricHit::Surface;
  switch (pixel.surface) {
    case Surface::near_root:
      return hit.surface == Exact::near_root;
    case Surface::far_root:
      return hit.surface == Exact::far_root;
    case Surface::cap:
      return hit.surface == Exact::plane && hit.plane == pixel.cap;
    default:
      return hit.surface == Exact::near_plane;
  }
}

// Shown frames against judged ones, pixel by pixel.
class Comparison {
 public:
  Comparison(const JudgedFrame& judged, const frame::Frame& shown, Figures& figures)
      : judged_(judged),
        shown_(shown),
        f_(figures),
        depth_bits_(static_cast<unsigned>(judged.machine().object_processor.word_bits)),
        logic_(judged.machine().quadric, depth_bits_, imogene::depth_range(judged.machine())),
        unit_(std::ldexp(
            1.0, quadric_processor::depth_fraction_bits(static_cast<int>(depth_bits_), shown.columns, shown.lines))) {}

  void all_pixels() {
    for (std::size_t y = 0; y < shown_.lines; ++y)
      for (std::size_t x = 0; x < shown_.columns; ++x) look_at(x, y);
  }

 private:
  void look_at(std::size_t x, std::size_t y) {
    const std::size_t at = y * shown_.columns + x;
    const std::uint32_t object = shown_.object[at];
    const auto depth = static_cast<double>(shown_.depth[at]);
    const std::vector<SeenRange> all = judged_.ranges(x, y);
    // Whatever is there for certain hides what is behind its farthest.
    double farthest = std::numeric_limits<double>::infinity();
    std::size_t certain = 0;
    for (const SeenRange& range : all) {
      if (!range.certain) continue;
      ++certain;
      farthest = std::min(farthest, range.high);
    }
    const auto possible = [&](const SeenRange& range) { return range.low <= farthest; };
    const auto choices = std::count_if(all.begin(), all.end(), possible) + (certain == 0 ? 1 : 0);
    ++f_.pixels;
    if (object == 0) {
      if (certain > 0) f_.note("nothing is shown", x, y);
      if (choices > 1) ++f_.excused;
      if (choices == 1 && judged_.exact.object[at] != 0)
        f_.note("nothing, and the exact picture shows something", x, y);
      return;
    }
    const auto found =
        std::find_if(all.begin(), all.end(), [object](const SeenRange& range) { return range.object == object; });
    // Of several triangles the layer of triangles has the nearest: the others are not worked out, and are not shown
    // unless as near.
    if (found == all.end()) {
      const bool near_triangle = !judged_.is_solid(object) && !all.empty() && !judged_.is_solid(all[0].object) &&
                                 depth >= all[0].low && depth <= all[0].high;
      if (near_triangle)
        ++f_.excused;
      else
        f_.note(fmt::format("object {} is shown, which is not there", object), x, y);
      return;
    }
    if (!possible(*found)) f_.note(fmt::format("object {} is shown, which is hidden", object), x, y);
    if (depth < found->low || depth > std::min(farthest, found->certain ? found->high : farthest))
      f_.note(fmt::format("object {} is shown at another depth", object), x, y);
    if (certain == all.size() && shown_.coverage[at] != judged_.exact.coverage[at])
      f_.note("another number of objects covers it", x, y);
    if (!judged_.is_solid(object)) ++f_.by_triangles;
    look_at_words(x, y);
    if (choices > 1) {
      ++(depth == judged_.near() ? f_.ties : f_.excused);
      return;
    }
    if (judged_.exact.object[at] != object) {
      f_.note(fmt::format("object {} is shown instead of {}", object, judged_.exact.object[at]), x, y);
      return;
    }
    if (judged_.is_solid(object)) look_at_solid(x, y, *found);
  }

  QuadricPixel pixel_of(const JudgedSolid& solid, std::size_t x, std::size_t y) const {
    return logic_(solid.words(), quadric_processor::pixel_words(solid.words(), static_cast<std::uint32_t>(x),
                                                                static_cast<std::uint32_t>(y),
                                                                judged_.machine().quadric, depth_bits_));
  }

  // Of all solids' words the nearest is shown, of equal ones that of the lowest board and slot: solid i has slot i / B
  // of board i mod B. A triangle is shown where none is nearer.
  void look_at_words(std::size_t x, std::size_t y) {
    const std::size_t at = y * shown_.columns + x;
    const auto boards = static_cast<std::size_t>(judged_.machine().host.computation_units);
    std::uint32_t object = 0, nearest = ~0U;
    for (std::size_t board = 0; board < boards; ++board)
      for (std::size_t i = board; i < judged_.solids.size(); i += boards) {
        const QuadricPixel pixel = pixel_of(judged_.solids[i], x, y);
        if (!pixel.covered || pixel.depth >= nearest) continue;
        nearest = pixel.depth;
        object = judged_.solids[i].placed().number();
      }
    if (judged_.is_solid(shown_.object[at]) ? object != shown_.object[at] : nearest < shown_.depth[at])
      f_.note(fmt::format("object {} is shown, and words show {}", shown_.object[at], object), x, y);
  }

  void look_at_solid(std::size_t x, std::size_t y, const SeenRange& range) {
    const std::size_t at = y * shown_.columns + x;
    const auto column = static_cast<double>(x), line = static_cast<double>(y);
    const JudgedSolid& solid = *std::find_if(judged_.solids.begin(), judged_.solids.end(), [&](const JudgedSolid& one) {
      return one.placed().number() == range.object;
    });
    ++f_.of_solids;
    const double off = std::abs(shown_.depth[at] - judged_.word(judged_.exact.depth[at])) / unit_;
    f_.depth = std::max(f_.depth, off);
    if (off > 0.427) ++f_.deep;
    f_.depth_bound = std::max(f_.depth_bound, (range.high - range.low) / unit_);
    const QuadricPixel pixel =
        logic_(solid.words(),
               quadric_processor::pixel_words(solid.words(), static_cast<std::uint32_t>(x),
                                              static_cast<std::uint32_t>(y), judged_.machine().quadric, depth_bits_));
    if (!pixel.covered || pixel.depth != shown_.depth[at]) {
      f_.note("the words of the solid show another depth", x, y);
      return;
    }
    const auto hit = solid.placed().hit(column, line);
    if (!hit) return f_.note("its ray misses the solid", x, y);
    if (!same_surface(pixel, *hit)) {
      ++f_.other_face;
      const double apart = std::abs(solid.depth_of(pixel, column, line) - judged_.word(hit->depth));
      if (apart > range.high - range.low) f_.note("another surface of the solid is shown", x, y);
      return;
    }
    ++f_.surfaces.at(static_cast<std::size_t>(pixel.surface));
    look_at_normal(x, y, solid, pixel, *hit);
  }

  void look_at_normal(std::size_t x, std::size_t y, const JudgedSolid& solid, const QuadricPixel& pixel,
                      const geometry::QuadricHit& hit) {
    const std::size_t at = 3 * (y * shown_.columns + x);
    const auto column = static_cast<double>(x), line = static_cast<double>(y);
    const glm::dvec3 exact = solid.placed().point(hit, column, line).normal;
    const auto bound =
        solid.normal_bound(pixel, column, line, static_cast<unsigned>(judged_.machine().object_processor.normal_bits));
    if (!bound || glm::length(exact) == 0.0) {
      ++f_.no_bound;
      return;
    }
    const glm::dvec3 shown(shown_.normal[at], shown_.normal[at + 1], shown_.normal[at + 2]);
    const glm::dvec3 unit = glm::normalize(exact);
    const double angle = std::atan2(glm::length(glm::cross(shown, unit)), glm::dot(shown, unit));
    ++f_.normals;
    f_.angle = std::max(f_.angle, angle);
    f_.of_bound = std::max(f_.of_bound, angle / *bound);
    constexpr double kOfFloats = 1e-6;
    if (angle > *bound + kOfFloats) f_.note("the normal is off", x, y);
  }

  const JudgedFrame& judged_;
  const frame::Frame& shown_;
  Figures& f_;
  unsigned depth_bits_;
  quadric_processor::QuadricPixelLogic logic_;
  double unit_;
};

class SolidsTest : public SimulationTest {
 protected:
  static constexpr std::uint64_t kFrames = 5;

  void expect_right(const std::string& file, const std::vector<std::string>& set, std::uint64_t frames,
                    Figures& figures, std::size_t& refused) const {
    std::vector<std::string> all{"host.sustained_mflops=50.0", "quadric_processor.on_refusal=drop"};
    all.insert(all.end(), set.begin(), set.end());
    const Simulated simulated = simulate(kQuadricMachine, file, {.set = all, .frames = frames, .reference = false});
    const run::Inputs inputs = run::read_inputs(kQuadricMachine, file, all);
    ASSERT_EQ(simulated.shown.size(), frames);
    for (std::uint64_t k = 0; k < frames; ++k) {
      const JudgedFrame judged(inputs, simulated.result.frames[k].animation_frame);
      ASSERT_EQ(simulated.result.frames[k].animation_frame, static_cast<std::int64_t>(k)) << "the host is late";
      EXPECT_EQ(simulated.result.frames[k].solids_refused, judged.refused()) << "frame " << k;
      refused += judged.refused();
      // The exact picture has what the machine leaves out.
      if (judged.refused() > 0) continue;
      const std::uint64_t before = figures.wrong;
      Comparison(judged, simulated.shown[k], figures).all_pixels();
      EXPECT_EQ(figures.wrong, before) << "frame " << k << ", the first: " << figures.first_wrong;
    }
  }

  static void print(const char* name, const Figures& f, std::size_t refused) {
    std::cout << fmt::format(
        "{}: {} pixels of solids in {}, {} of triangles; {} excused, {} ties; depth to {:.4f} units (bounds to "
        "{:.4f}), by more than 0.427 at {} pixels; "
        "normals to {:.4f} degrees, {:.2f} of their bounds at most, {} without bound, {} of another face; near roots, "
        "far roots, near plane, caps: {}, {}, {}, {}; {} refused\n",
        name, f.of_solids, f.pixels, f.by_triangles, f.excused, f.ties, f.depth, f.depth_bound, f.deep,
        f.angle * 180 / std::numbers::pi, f.of_bound, f.no_bound, f.other_face, f.surfaces[0], f.surfaces[1],
        f.surfaces[2], f.surfaces[3], refused);
  }

  Figures random_scenes(const char* name, View view, std::initializer_list<std::uint32_t> seeds,
                        const std::vector<std::string>& set) const {
    Figures figures;
    std::size_t refused = 0;
    for (const std::uint32_t seed : seeds) {
      SCOPED_TRACE(fmt::format("{}, seed {}", name, seed));
      expect_right(written("scene.toml", SolidScene(seed, view).text()), set, kFrames, figures, refused);
    }
    print(name, figures, refused);
    EXPECT_GT(figures.of_solids, figures.pixels / 10);
    EXPECT_GT(figures.by_triangles, 100U);
    // Bounds that excuse much would say nothing: outlines and seams are lines.
    EXPECT_LT(figures.excused + figures.other_face, figures.pixels / 200);
    EXPECT_LT(figures.no_bound, figures.pixels / 1000);
    EXPECT_GT(figures.surfaces[0], 1000U);
    EXPECT_GT(figures.surfaces[3], 1000U);
    return figures;
  }
};

const std::vector<std::string> kSmall{"video.columns=176", "video.lines=144"};

TEST_F(SolidsTest, RandomScenesInPerspective) {
  random_scenes("perspective", View::perspective, {1, 2, 3, 4, 5, 6, 7, 8}, kSmall);
}

TEST_F(SolidsTest, RandomScenesInParallelProjection) {
  random_scenes("orthographic", View::orthographic, {11, 12, 13, 14, 15, 16, 17, 18}, kSmall);
}

TEST_F(SolidsTest, TheNearPlaneShowsWhatItCuts) {
  const Figures figures = random_scenes("near plane", View::near_cuts, {21, 22, 23, 24, 25}, kSmall);
  EXPECT_GT(figures.surfaces[2], 1000U);
}

TEST_F(SolidsTest, TheEyeIsWithinQuadrics) {
  const Figures figures = random_scenes("eye inside", View::eye_inside, {31, 32, 33, 34, 35}, kSmall);
  EXPECT_GT(figures.surfaces[1], 1000U);
}

TEST_F(SolidsTest, OtherWidths) {
  random_scenes("narrow", View::perspective, {41, 42},
                {"video.columns=144", "video.lines=176", "object_processor.normal_bits=10",
                 "quadric_processor.root_guard_bits=4", "quadric_processor.root_reading=floor",
                 "quadric_processor.multiplier_bits=20", "quadric_processor.alignment=delay"});
  random_scenes("fixed scale", View::orthographic, {43, 44},
                {"video.columns=144", "video.lines=176", "quadric_processor.scaling=fixed",
                 "quadric_processor.word_bits=54", "quadric_processor.fraction_bits=20"});
}

TEST_F(SolidsTest, TheTableOfSolidsAtItsOwnSize) {
  Figures figures;
  std::size_t refused = 0;
  expect_right(RASTERTLM_SOURCE_DIR "/configs/scenes/solids.toml", {}, 3, figures, refused);
  print("solids.toml", figures, refused);
  EXPECT_EQ(refused, 0U);
  EXPECT_GT(figures.of_solids, 100'000U);
  EXPECT_LT(figures.excused + figures.other_face, figures.pixels / 200);
}

}  // namespace
}  // namespace rastertlm::test
