// The spheres of 000/001, figures 9 to 11: how far is each method from a picture that is lit at every pixel?
//
// Everything is computed in double and not rounded to levels, over the pixels that both pictures cover. The figures are
// those that the machine was specified by, measured with a program of their own. What the span unit shows, in 8 bits,
// adds the rounding: 1/12 to the mean of the squares.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "src/reference/renderer.h"
#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm {
namespace {

struct Distance {
  double rmse = 0.0;
  double largest = 0.0;
  double psnr = 0.0;
  double rmse_in_8_bits = 0.0;
};

struct Given {
  const char* mesh;
  int exponent;
  const char* method;
  const char* points;
  double rmse, largest, psnr;  // 0: not in the table
};

class SphereTest : public testing::TestWithParam<Given> {
 protected:
  static run::Inputs inputs_of(const Given& given) {
    std::vector<std::string> overrides{"set_up.method=" + std::string(given.method),
                                       "material[0].exponent=" + std::to_string(given.exponent)};
    if (std::string(given.method) == "quadratic_adaptive")
      overrides.push_back("highlight_test.points=" + std::string(given.points));
    return test::sphere_inputs(given.mesh, overrides);
  }
};

// The colours that the set-up processor found, evaluated in double where the span unit draws; and what that shows.
struct Interpolated {
  std::vector<double> red;
  std::vector<std::uint32_t> shown;
  std::vector<std::uint32_t> objects;
};
Interpolated interpolated(const run::Inputs& inputs) {
  const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
  const std::size_t columns = machine.viewport().columns;
  const std::size_t size = columns * machine.viewport().lines;
  Interpolated picture{std::vector<double>(size), std::vector<std::uint32_t>(size), std::vector<std::uint32_t>(size)};
  test::visit_spans(
      inputs, [&](const set_up::ColourTriangle& triangle, const span_unit::Span& span, const test::SpanPixels& pixels) {
        for (std::uint32_t x = 0; x < span.count; ++x) {
          const std::size_t pixel = span.line * columns + span.column + x;
          picture.objects[pixel] = triangle.object;
          picture.red[pixel] = std::clamp(test::colour_at(triangle, 0, span.column + x, span.line), 0.0, 255.0);
          picture.shown[pixel] = pixels.levels[x] & 0xFFU;
        }
      });
  return picture;
}

Distance distance(const run::Inputs& inputs) {
  const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
  const scene::Scene& scene = *inputs.content->scene;
  const scene::Pose pose = scene::pose(scene, 0, machine.viewport().columns, machine.viewport().lines);
  reference::RenderOptions options;
  options.columns = machine.viewport().columns;
  options.lines = machine.viewport().lines;
  options.grids = host::span_grids(machine.viewport(), 4);
  const frame::ExactFrame exact = reference::render(scene, pose, options);
  const Interpolated picture = interpolated(inputs);
  double sum = 0.0;
  double sum_in_8_bits = 0.0;
  std::size_t compared = 0;
  Distance d;
  for (std::size_t pixel = 0; pixel < picture.red.size(); ++pixel) {
    if (picture.objects[pixel] == 0 || exact.object[pixel] == 0) continue;
    const double off = picture.red[pixel] - exact.rgb[3 * pixel];
    const double off_in_8_bits = picture.shown[pixel] - static_cast<double>(exact.rgb[3 * pixel]);
    sum += off * off;
    sum_in_8_bits += off_in_8_bits * off_in_8_bits;
    d.largest = std::max(d.largest, std::fabs(off));
    ++compared;
  }
  d.rmse = std::sqrt(sum / static_cast<double>(compared));
  d.rmse_in_8_bits = std::sqrt(sum_in_8_bits / static_cast<double>(compared));
  d.psnr = 20 * std::log10(255 / d.rmse);
  return d;
}

TEST_P(SphereTest, IsAsFarFromLightAtEveryPixelAsTheTableSays) {
  const Given& given = GetParam();
  const Distance d = distance(inputs_of(given));
  const double in_8_bits = std::sqrt(given.rmse * given.rmse + 1.0 / 12);
  std::printf("%s %d %s %s: RMSE %.3f, in 8 bits %.3f of %.3f, largest %.2f, PSNR %.2f dB\n", given.mesh,
              given.exponent, given.method, given.points, d.rmse, d.rmse_in_8_bits, in_8_bits, d.largest, d.psnr);
  EXPECT_NEAR(d.rmse, given.rmse, 0.03 * given.rmse);
  EXPECT_NEAR(d.rmse_in_8_bits, in_8_bits, 0.03 * in_8_bits);
  if (given.largest > 0) {
    EXPECT_NEAR(d.largest, given.largest, 0.03 * given.largest);
  }
  if (given.psnr > 0) {
    EXPECT_NEAR(d.psnr, given.psnr, 0.03 * given.psnr);
  }
}

constexpr Given kTable[] = {
    {"168", 5, "gouraud", "", 11.88, 67.9, 26.6},
    {"168", 5, "quadratic", "", 2.11, 17.5, 41.7},
    {"168", 5, "quadratic_adaptive", "centroid", 1.63, 17.5, 43.9},
    {"168", 50, "gouraud", "", 8.60, 107.6, 29.4},
    {"168", 50, "quadratic", "", 4.65, 54.7, 34.8},
    {"168", 50, "quadratic_adaptive", "centroid", 3.55, 54.6, 37.1},
    {"168", 50, "quadratic_adaptive", "points", 0.93, 6.2, 0},
    {"374", 5, "gouraud", "", 6.10, 34.9, 32.4},
    {"374", 5, "quadratic", "", 0.91, 7.1, 48.9},
    {"374", 5, "quadratic_adaptive", "centroid", 0.91, 7.1, 48.9},
    {"374", 50, "gouraud", "", 6.71, 94.4, 31.6},
    {"374", 50, "quadratic", "", 3.31, 42.4, 37.8},
    {"374", 50, "quadratic_adaptive", "centroid", 1.44, 41.8, 45.0},
    {"690", 5, "gouraud", "", 3.44, 24.7, 37.4},
    {"690", 5, "quadratic", "", 0.49, 3.9, 54.4},
    {"690", 5, "quadratic_adaptive", "centroid", 0.49, 3.9, 54.4},
    {"690", 50, "gouraud", "", 5.93, 88.9, 32.7},
    {"690", 50, "quadratic", "", 1.94, 37.8, 42.4},
    {"690", 50, "quadratic_adaptive", "centroid", 1.48, 37.8, 44.8},
};
INSTANTIATE_TEST_SUITE_P(Table, SphereTest, testing::ValuesIn(kTable), [](const auto& one) {
  const Given& g = one.param;
  return "Of" + std::string(g.mesh) + "Exponent" + std::to_string(g.exponent) + g.method + g.points;
});

// Comparing colours at the centre misses a highlight that is beside it; the signs of H1 and H2 at the corners do not.
TEST(Spheres, H1AndH2FindAHighlightBesideTheCentre) {
  const auto with = [](const char* points) {
    return distance(test::sphere_inputs("168", {"set_up.method=quadratic_adaptive", "material[0].exponent=50",
                                                std::string("highlight_test.points=") + points}));
  };
  const Distance at_centre = with("centroid"), by_signs = with("h1h2");
  EXPECT_LT(by_signs.rmse, 0.5 * at_centre.rmse);
  EXPECT_LT(by_signs.largest, 0.3 * at_centre.largest);
}

// The further test points find a highlight that is beside the centre.
TEST(Spheres, FurtherTestPointsKeepTheErrorSmall) {
  const Distance d = distance(test::sphere_inputs(
      "168", {"set_up.method=quadratic_adaptive", "highlight_test.points=points", "material[0].exponent=50"}));
  EXPECT_LE(d.rmse, 1.1);
}

}  // namespace
}  // namespace rastertlm
