// What does a frame cost a computer that draws it in software, and are the times those of the paper?
#include <gtest/gtest.h>

#include <stdexcept>

#include "modules/host/software_renderer.h"
#include "tests/platforms/quadratic/screens.h"
#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm::test {
namespace {

using host::SoftwareWork;

SoftwareWork work_of(const quadratic::Machine& machine, const scene::Scene& scene, ShadingMethod method) {
  const quadratic::Quadratic platform(machine, scene, {1, false}, {});
  return host::software_work(
      platform.rendering(), method,
      scene::pose(scene, 0, machine.set_up_format().viewport.columns, machine.set_up_format().viewport.lines));
}

double paper_ms(ShadingMethod method) {
  const run::Inputs inputs = sphere_inputs("168", {});
  const auto& machine = std::get<quadratic::Machine>(inputs.content->machine);
  EXPECT_EQ(machine.software.preset, "pc_2000");
  return 1e3 * host::software_seconds(machine.software, work_of(machine, *inputs.content->scene, method));
}

// 000/001, section 6, on the coarse sphere: 230, 250 and 450 ms. The first and the last are fitted, the other one is
// not.
TEST(Software, GouraudOfThePaperIsFitted) { EXPECT_NEAR(paper_ms(ShadingMethod::gouraud), 230.0, 0.1); }
TEST(Software, PhongOfThePaperIsFitted) { EXPECT_NEAR(paper_ms(ShadingMethod::phong), 450.0, 0.1); }
TEST(Software, QuadraticOfThePaperIsPredicted) { EXPECT_NEAR(paper_ms(ShadingMethod::quadratic), 250.0, 0.05 * 250.0); }

// A screen of 64 x 64 pixels, all of which see the light straight on.
constexpr std::uint64_t kPixels = 64 * 64;

SoftwareWork screen_work(ShadingMethod method) {
  scene::Scene scene = screen_scene(64);
  add_rectangle(scene, 64, 64, 0, 64);
  return work_of(span_unit_alone(64, 64), scene, method);
}

// Light at a point that a single directional light strikes and shines on, Blinn, exponent 20 (10100 in binary): the
// normal to unit length (a dot product of 3 and 2, a comparison, a root, a division, 3 to scale) and its ambient light
// (3); N.L (3, 2); L + V (3 additions) to unit length, N.H (3, 2); the power by squaring (4 squares, 2 products); two
// comparisons for each of the terms' signs; three channels of diffuse and specular light (4 products, 2 sums each);
// full scale (3) and its clamps (6 comparisons). Those of set-up's own code: counted, and compared here in sum.
constexpr std::uint64_t kUnit = 3 + 2 + 1 + 1 + 1 + 3;
constexpr std::uint64_t kLight = kUnit + 3 + (3 + 2) + 3 + kUnit + (3 + 2) + (4 + 2) + 2 + 3 * (4 + 2) + 3 + 6;

TEST(Software, CountsWhatPixelsTake) {
  const SoftwareWork gouraud = screen_work(ShadingMethod::gouraud);
  const SoftwareWork quadratic = screen_work(ShadingMethod::quadratic);
  const SoftwareWork phong = screen_work(ShadingMethod::phong);
  for (const SoftwareWork* work : {&gouraud, &quadratic, &phong}) {
    EXPECT_EQ(work->triangles, 2U);
    EXPECT_EQ(work->pixels, kPixels);
  }
  // Light at each pixel, and not at six corners; planes of normals, set up otherwise than those of colours.
  constexpr double kPlanes = 2 * 50;
  EXPECT_NEAR(static_cast<double>(phong.operations.flops() - gouraud.operations.flops()),
              static_cast<double>((kPixels - 6) * kLight), kPlanes);
  EXPECT_EQ(gouraud.lights, 6U);
  EXPECT_EQ(quadratic.lights, 12U);
  EXPECT_EQ(phong.lights, kPixels);
  EXPECT_EQ(phong.lit_pixels, kPixels);
  EXPECT_EQ(gouraud.lit_pixels, 0U);
  // Three more additions a pixel; light at three more points of a triangle and its solution, some hundreds a triangle.
  const std::uint64_t more = quadratic.operations.flops() - gouraud.operations.flops() - 3 * kPixels;
  EXPECT_GT(more, 2 * 3 * kLight);
  EXPECT_LT(more, 2 * (3 * kLight + 600));
}

TEST(Software, TakesItsTime) {
  host::SoftwareParameters computer;
  computer.sustained_mflops = 2.0;
  computer.frame_us = 100.0;
  computer.triangle_us = 10.0;
  computer.pixel_ns = 500.0;
  computer.light_us = 0.25;
  SoftwareWork work;
  work.triangles = 3;
  work.pixels = 8;
  work.lights = 20;
  work.operations.add = 4;
  work.operations.divide = 2;
  work.operations.integer = 1'000'000;  // in the sustained rate
  EXPECT_NEAR(host::software_seconds(computer, work), 1e-6 * (100 + 30 + 4 + 3 + 5), 1e-12);
}

TEST(Software, KnowsTheMethodsOfThePapersAlone) {
  for (const ShadingMethod method :
       {ShadingMethod::highlight_subdivision, ShadingMethod::regular_subdivision, ShadingMethod::gouraud_phong})
    EXPECT_GE(screen_work(method).triangles, 2U);
  for (const ShadingMethod method : {ShadingMethod::duff, ShadingMethod::taylor, ShadingMethod::angular,
                                     ShadingMethod::pseudo_phong, ShadingMethod::quadratic_adaptive}) {
    EXPECT_FALSE(host::has_software(method));
    EXPECT_THROW(screen_work(method), std::invalid_argument);
  }
}

}  // namespace
}  // namespace rastertlm::test
