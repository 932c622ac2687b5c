// A machine whose pixels are shaded one by one behind its span unit: is its picture the exact one rounded, and does the
// pixel unit take what its parameters say?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

#include "platforms/quadratic/quadratic.h"
#include "src/reference/renderer.h"
#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm::test {
namespace {

struct Shown {
  run::Inputs inputs = sphere_inputs("168", {"video.columns=96", "video.lines=96", "set_up.attributes=linear"});
  quadratic::Machine machine = std::get<quadratic::Machine>(inputs.content->machine);
  frame::Frame picture;
  frame::ExactFrame exact;
  std::unique_ptr<quadratic::Quadratic> platform;

  explicit Shown(ShadingMethod method) {
    machine.set_up.method = method;
    const scene::Scene& scene = *inputs.content->scene;
    platform = std::make_unique<quadratic::Quadratic>(
        machine, scene, quadratic::Options{1, true},
        [this](const quadratic::ShownFrame&, const frame::Frame& shown) { picture = shown; });
    platform->run();
    reference::RenderOptions options;
    options.kind = reference::Reference::snapped;
    options.columns = options.lines = 96;
    options.grids = host::span_grids(machine.viewport(), static_cast<int>(machine.set_up.snap_bits));
    options.lights_at_points = true;
    exact = reference::render(scene, scene::pose(scene, 0, 96, 96), options);
  }
  // Levels, the largest of a pixel's channels.
  double off(std::size_t pixel) const {
    double largest = 0.0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
      largest = std::max(largest, std::fabs(picture.rgb[c] - exact.rgb[c]));
    return largest;
  }
};

TEST(PixelUnit, ShowsTheExactPictureRounded) {
  const Shown phong(ShadingMethod::phong);
  EXPECT_EQ(phong.picture.object, phong.exact.object);
  for (std::size_t pixel = 0; pixel < phong.picture.pixels(); ++pixel) ASSERT_LE(phong.off(pixel), 0.5 + 1e-6) << pixel;
}

TEST(PixelUnit, ByTheQuotientAsWell) {
  const Shown duff(ShadingMethod::duff);
  for (std::size_t pixel = 0; pixel < duff.picture.pixels(); ++pixel) ASSERT_LE(duff.off(pixel), 0.5 + 1e-6) << pixel;
}

// Intervals, lines and loads, and no more; the span unit waits for all but the first span's.
TEST(PixelUnit, TakesItsCycles) {
  const Shown phong(ShadingMethod::phong);
  const pixel_unit::PixelUnitModule& unit = *phong.platform->pixel_unit();
  const pixel_unit::PixelUnitParameters& parameters = phong.machine.pixel_unit;
  const auto cycles = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
  const span_unit::SpanCounters spans = phong.platform->span_unit().counters();
  const pixel_unit::ShaderCounters& shaded = phong.platform->work().shader()->counters();
  EXPECT_EQ(unit.shaded(), spans.pixels);
  EXPECT_EQ(unit.passed(), 0U);
  EXPECT_EQ(shaded.lines, spans.lines - spans.empty_lines);
  EXPECT_EQ(unit.occupancy().busy, spans.pixels * cycles(parameters.cycles_per_pixel) +
                                       shaded.lines * cycles(parameters.cycles_per_line) +
                                       shaded.triangles * cycles(parameters.load_cycles));
  EXPECT_GT(phong.platform->span_unit().occupancies().front().blocked, spans.pixels);
  EXPECT_EQ(phong.platform->frames().back().drawn_ps, unit.drained_ps());
}

// Triangles with a highlight are the exact picture rounded, others are not; each pixel is one or the other.
TEST(PixelUnit, ShadesTrianglesWithAHighlightAlone) {
  const Shown chosen(ShadingMethod::gouraud_phong);
  const pixel_unit::PixelUnitModule& unit = *chosen.platform->pixel_unit();
  EXPECT_GT(unit.shaded(), 0U);
  EXPECT_GT(unit.passed(), 0U);
  EXPECT_EQ(unit.shaded() + unit.passed(), chosen.platform->span_unit().counters().pixels);
  std::size_t exact = 0;
  std::size_t covered = 0;
  for (std::size_t pixel = 0; pixel < chosen.picture.pixels(); ++pixel) {
    if (chosen.picture.object[pixel] == 0) continue;
    ++covered;
    exact += chosen.off(pixel) <= 0.5 + 1e-6 ? 1 : 0;
  }
  EXPECT_GE(exact, unit.shaded());  // a closed surface seen from outside: nothing is hidden
  EXPECT_LT(exact, covered);
}

}  // namespace
}  // namespace rastertlm::test
