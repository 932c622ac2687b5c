// Are ranges those of all pixels of a box, outlines within their boxes, and bounding quadrics around their solids?
#include "modules/set_up/screen_box.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "modules/set_up/quadric_region.h"
#include "modules/set_up/solid_in_eye_space.h"
#include "tests/modules/set_up/solids.h"

namespace rastertlm::set_up {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low));
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

geometry::SecondOrderForm<double> any_form(Random& random) {
  const auto zero_or = [&](double limit) { return random.whole(0, 5) == 0 ? 0.0 : random.uniform(-limit, limit); };
  return {zero_or(1), zero_or(1), zero_or(1), zero_or(40), zero_or(40), zero_or(900)};
}

// No value of a pixel is beyond the range, and both ends are taken within a step of a pixel's hundredth.
RC_GTEST_PROP(ScreenBox, RangesAreThoseOfTheBox, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const geometry::SecondOrderForm<double> form = any_form(random);
  PixelBox box{random.whole(-9, 20), 0, random.whole(-9, 20), 0};
  box.right = box.left + random.whole(0, 12);
  box.bottom = box.top + random.whole(0, 12);
  const Range<double> range = range_in(form, box);
  double least = 1e300, most = -1e300;
  constexpr int kSteps = 240;
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k) {
      const double x = static_cast<double>(box.left) + static_cast<double>(box.right - box.left) * i / kSteps;
      const double y = static_cast<double>(box.top) + static_cast<double>(box.bottom - box.top) * k / kSteps;
      least = std::min(least, form.at(x, y));
      most = std::max(most, form.at(x, y));
    }
  RC_ASSERT(least >= range.least - 1e-9);
  RC_ASSERT(most <= range.most + 1e-9);
  RC_ASSERT(least <= range.least + 1e-2);
  RC_ASSERT(most >= range.most - 1e-2);
  RC_ASSERT(range.largest_magnitude() == std::max(std::abs(range.least), std::abs(range.most)));
}

RC_GTEST_PROP(ScreenBox, AnOutlineIsWithinItsBoxAndFillsIt, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const PixelBox screen{0, 63, 0, 47};
  const geometry::SecondOrderForm<double> form = any_form(random);
  const auto ellipse = ellipse_of(form);
  RC_CLASSIFY(ellipse.has_value(), "ellipse");
  if (!ellipse) return;
  const double more = random.uniform(0, 100);
  const PixelBox box = ellipse->box(more, screen);
  for (std::int64_t y = 0; y < 48; ++y)
    for (std::int64_t x = 0; x < 64; ++x)
      if (form.at(static_cast<double>(x), static_cast<double>(y)) + more >= 0)
        RC_ASSERT(x >= box.left && x <= box.right && y >= box.top && y <= box.bottom);
  if (box.empty()) return;
  // One pixel to the left of the box, and on the column of its left side, on the whole line.
  const auto best_on_column = [&](std::int64_t x) {
    return range_in(form, PixelBox{x, x, -1000000, 1000000}).most + more;
  };
  if (box.left > 0) RC_ASSERT(best_on_column(box.left - 1) < 1e-3);
  if (box.left > 0) RC_ASSERT(best_on_column(box.left) > -0.1 * std::abs(ellipse->at_middle + more) - 1e-3);
}

RC_GTEST_PROP(ScreenBox, ABoundingQuadricIsAroundTheSolid, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const SolidShape& shape = kSolidShapes[static_cast<std::size_t>(random.whole(2, 8))];
  const glm::dmat4 place = random_place(random.engine());
  const PlacedSolid solid = placed_solid(shape, place);
  const auto around = bounding_quadric<double>(solid.quadric, solid.planes);
  RC_CLASSIFY(around.has_value(), "bounded", shape.name);
  if (!around) return;
  int inside = 0;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec4 at =
        place * glm::dvec4(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.1, 1.1), 1.0);
    bool within = glm::dot(at, solid.quadric * at) <= 0;
    for (const glm::dvec4& plane : solid.planes) within = within && glm::dot(plane, at) <= 0;
    if (!within) continue;
    ++inside;
    RC_ASSERT(glm::dot(at, *around * at) <= 1e-9);
  }
  RC_ASSERT(inside > 0);
}

void expect_near(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) RC_ASSERT(std::abs(a[column][row] - b[column][row]) <= tolerance);
}

RC_GTEST_PROP(SolidInEyeSpace, IsWhatMatricesOfGlmMakeOfIt, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  glm::dmat4 any;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) any[column][row] = random.uniform(-2, 2) + (row == column ? 8.0 : 0.0);
  expect_near(inverse<double>(any), glm::inverse(any), 1e-12);
  const glm::dmat4 place = random_place(random.engine());
  expect_near(affine_inverse<double>(place), glm::inverse(place), 1e-9);
  for (const bool perspective : {false, true}) {
    const glm::dmat4 clip =
        perspective ? glm::perspectiveRH_ZO(1.0, 1.3, 1.0, 20.0) : glm::orthoRH_ZO(-4.0, 4.0, -3.0, 3.0, 1.0, 20.0);
    expect_near(screen_to_eye<double>(clip, {64, 48}), glm::inverse(geometry::eye_to_screen(clip, {64, 48})), 1e-9);
  }
  geometry::Solid solid;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row <= column; ++row)
      solid.quadric[column][row] = solid.quadric[row][column] = random.uniform(-1, 1);
  solid.planes = {{0.6, 0, 0.8, random.uniform(-1, 1)}, {0, 1, 0, 0.5}};
  const EyeSolid placed = solid_in_eye_space<double>(solid, place);
  const glm::dmat4 expected = geometry::quadric_in_eye_space(solid.quadric, place);
  double largest = 0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(expected[column][row]));
  expect_near(placed.quadric, expected, 1e-12 * largest);
  RC_ASSERT(placed.quadric == glm::transpose(placed.quadric));
  RC_ASSERT(placed.planes.size() == 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::dvec4 plane = glm::transpose(glm::inverse(place)) * solid.planes[i];
    for (int k = 0; k < 4; ++k) RC_ASSERT(std::abs(plane[k] - placed.planes[i][k]) <= 1e-8);
  }
}

}  // namespace
}  // namespace rastertlm::set_up
