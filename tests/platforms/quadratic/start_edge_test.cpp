// How far are the levels of the papers' spheres from what their coefficients say, by each way of following the start
// edge? Rounding to levels takes a half, which is not counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/platforms/quadratic/sphere_frames.h"

namespace rastertlm::test {
namespace {

double largest_error(const std::string& mesh, int exponent, const std::string& start_edge) {
  const run::Inputs inputs =
      sphere_inputs(mesh, {"material[0].exponent=" + std::to_string(exponent), "span_unit.start_edge=" + start_edge});
  double largest = 0.0;
  visit_spans(inputs,
              [&](const set_up::ColourTriangle& triangle, const span_unit::Span& span, const SpanPixels& pixels) {
                for (std::uint32_t x = 0; x < span.count; ++x) {
                  const double exact = std::clamp(colour_at(triangle, 0, span.column + x, span.line), 0.0, 255.0);
                  largest = std::max(largest, std::fabs((pixels.levels[x] & 0xFFU) - exact) - 0.5);
                }
              });
  return largest;
}

struct Given {
  const char* mesh;
  int exponent;
  double published;  // X = ceil
};
class StartEdgeTest : public testing::TestWithParam<Given> {};

TEST_P(StartEdgeTest, ErrsAsTheTableSays) {
  const Given& given = GetParam();
  const double lattice = largest_error(given.mesh, given.exponent, "lattice");
  const double prestep = largest_error(given.mesh, given.exponent, "prestep");
  const double published = largest_error(given.mesh, given.exponent, "published");
  std::printf("%s, exponent %d: lattice %.4f, prestep %.4f, published %.2f\n", given.mesh, given.exponent, lattice,
              prestep, published);
  EXPECT_LE(lattice, 0.02);
  EXPECT_LE(prestep, 0.02);
  // Where the largest error falls on a level's middle it looks half a level smaller, or larger.
  EXPECT_NEAR(published, given.published, 0.6);
}

INSTANTIATE_TEST_SUITE_P(Table, StartEdgeTest,
                         testing::Values(Given{"168", 5, 4.26}, Given{"168", 50, 4.26}, Given{"374", 5, 2.35},
                                         Given{"374", 50, 3.73}, Given{"690", 5, 3.30}, Given{"690", 50, 4.13}),
                         [](const auto& one) {
                           return "Of" + std::string(one.param.mesh) + "Exponent" + std::to_string(one.param.exponent);
                         });

}  // namespace
}  // namespace rastertlm::test
