// Do the words show the solid, in every format, and is what they cannot show refused with the width that would do?
#include "modules/set_up/quadric_set_up.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <iostream>
#include <numbers>

#include "src/geometry/counted.h"
#include "tests/modules/set_up/solid_comparison.h"

namespace rastertlm::set_up {
namespace {

using quadric_processor::RayPart;
using quadric_processor::RootReading;
using quadric_processor::Scaling;

// Uniform, whatever RapidCheck's size is.
template <class T>
T drawn(T from, T to) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(from, to));
}

QuadricFormat default_format(const geometry::Viewport& viewport) {
  return {{}, {24, viewport.columns, viewport.lines, EdgeForm::snapped}};
}

QuadricSetUp set_up(const PlacedSolid& solid, const View& view, const QuadricFormat& format) {
  return set_up_quadric<double>(solid.quadric, solid.planes, 7, view.screen_to_eye, format);
}

bool seen_anywhere(const PlacedSolid& solid, const View& view) {
  for (std::size_t y = 0; y < view.viewport.lines; ++y)
    for (std::size_t x = 0; x < view.viewport.columns; ++x)
      if (geometry::first_hit(solid.quadric, solid.planes,
                              geometry::pixel_ray(view.screen_to_eye, static_cast<double>(x), static_cast<double>(y))))
        return true;
  return false;
}

struct Case {
  const SolidShape* shape;
  View view;
  PlacedSolid solid;
};
Case any_case(bool large) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const SolidShape& shape = kSolidShapes[drawn<std::size_t>(0, kSolidShapes.size())];
  const geometry::Viewport viewport = large ? geometry::Viewport{512, 384} : geometry::Viewport{64, 48};
  return {&shape, view_of(drawn(0, 2) == 0, viewport), placed_solid(shape, random_place(random))};
}

RC_GTEST_PROP(QuadricSetUp, WordsShowTheSolid, ()) {
  const bool large = drawn(0, 4) == 0;
  const Case c = any_case(large);
  QuadricFormat format = default_format(c.view.viewport);
  format.parameters.root_reading = *rc::gen::element(RootReading::floor, RootReading::half_unit);
  const QuadricSetUp result = set_up(c.solid, c.view, format);
  RC_LOG() << c.shape->name << " " << result.problem.key << " " << result.problem.message << "\n";
  RC_CLASSIFY(result.outcome == QuadricOutcome::outside, "outside");
  RC_CLASSIFY(result.outcome == QuadricOutcome::drawn && result.words.part == RayPart::outside, "a < 0");
  if (result.outcome == QuadricOutcome::refused) {
    // Rays that are nearly along the surface's asymptotes need wider words; nothing else here does.
    const auto form = geometry::screen_quadric<double>(c.solid.quadric, c.view.screen_to_eye);
    RC_ASSERT(std::abs(form.middle.at(0, 0)) + std::sqrt(std::abs(form.discriminant.at(0, 0))) > 20);
    return;
  }
  if (result.outcome == QuadricOutcome::outside) {
    RC_ASSERT(!seen_anywhere(c.solid, c.view));
    return;
  }
  RC_ASSERT(result.words.material == 7U);
  const Seen seen = compare(c.solid, c.view, format, result, large ? 5 : 1);
  RC_ASSERT(seen.wrong == "");
  RC_CLASSIFY(seen.covered == 0, "drawn, nothing seen");
}

// Whatever the widths, what is drawn is right within its bounds; what is refused is drawn, or refused for another
// word, in the width that is named.
RC_GTEST_PROP(QuadricSetUp, TheWidthsThatAreNamedDo, ()) {
  const Case c = any_case(false);
  QuadricFormat format = default_format(c.view.viewport);
  format.words.word_bits = drawn(18, 29);
  quadric_processor::QuadricParameters& p = format.parameters;
  p.word_bits = drawn(22, 56);
  p.fraction_bits = drawn(2, 16);
  p.root_integer_bits = drawn(4, 13);
  p.root_guard_bits = drawn(1, 9);
  p.plane_bits = drawn<std::int64_t>(format.words.word_bits + 1, 46);
  p.multiplier_bits = drawn(14, 32);
  p.scaling = *rc::gen::element(Scaling::object, Scaling::fixed);
  p.root_reading = *rc::gen::element(RootReading::floor, RootReading::half_unit);
  QuadricSetUp result = set_up(c.solid, c.view, format);
  RC_CLASSIFY(result.outcome == QuadricOutcome::refused, "refused at first", result.problem.key);
  for (int tries = 0; result.outcome == QuadricOutcome::refused; ++tries) {
    const QuadricProblem problem = result.problem;
    RC_LOG() << problem.key << " " << problem.message << "\n";
    RC_ASSERT(tries < 4);
    std::int64_t* const width = problem.key == "quadric_processor.word_bits"           ? &p.word_bits
                                : problem.key == "quadric_processor.plane_bits"        ? &p.plane_bits
                                : problem.key == "quadric_processor.root_integer_bits" ? &p.root_integer_bits
                                                                                       : nullptr;
    RC_ASSERT(width != nullptr);
    if (problem.width == 0) {
      RC_ASSERT(problem.message.find("more than the") != std::string::npos);
      return;
    }
    RC_ASSERT(problem.width > *width);
    *width = problem.width;
    result = set_up(c.solid, c.view, format);
    RC_ASSERT(result.problem.key != problem.key);
  }
  if (result.outcome == QuadricOutcome::drawn) {
    RC_ASSERT(compare(c.solid, c.view, format, result, 1).wrong == "");
  }
}

RC_GTEST_PROP(QuadricSetUp, CountedNumbersMakeTheSameWords, ()) {
  const Case c = any_case(false);
  const QuadricFormat format = default_format(c.view.viewport);
  const QuadricSetUp plain = set_up(c.solid, c.view, format);
  const geometry::OperationCounts start = geometry::operation_counts;
  const QuadricSetUp counted =
      set_up_quadric<geometry::Counted<double>>(c.solid.quadric, c.solid.planes, 7, c.view.screen_to_eye, format);
  const geometry::OperationCounts counts = geometry::operation_counts - start;
  RC_ASSERT(plain.outcome == counted.outcome);
  RC_ASSERT(plain.words == counted.words);
  RC_ASSERT(plain.problem.message == counted.problem.message);
  RC_ASSERT(counts.flops() > 245U);
  RC_ASSERT(plain.outcome != QuadricOutcome::drawn || (counts.convert >= 15 && counts.integer_multiply >= 11));
}

// What a host has to do for a solid, beside what a reader would count by hand.
TEST(QuadricSetUp, Operations) {
  for (const SolidShape& shape : kSolidShapes) {
    const View view = view_of(true, {512, 512});
    const PlacedSolid solid = placed_solid(
        shape, glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0, -6)), 1.0, glm::dvec3(1, 0.2, 0)));
    const geometry::OperationCounts start = geometry::operation_counts;
    const QuadricSetUp result = set_up_quadric<geometry::Counted<double>>(
        solid.quadric, solid.planes, 7, view.screen_to_eye, default_format(view.viewport));
    const geometry::OperationCounts counts = geometry::operation_counts - start;
    std::cout << shape.name << ": " << counts.flops() << " operations, " << counts.divide << " of them divisions, "
              << counts.integer << " of integers\n";
    ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
    // The forms alone are 64 + 48 + 40 + 30, about 35 and 18.
    EXPECT_GT(counts.flops(), 235U);
    EXPECT_LT(counts.flops(), 1500U);
  }
}

QuadricFormat narrow_format() {
  QuadricFormat format = default_format({512, 512});
  format.parameters.word_bits = 24;
  format.parameters.fraction_bits = 4;
  format.parameters.root_integer_bits = 9;
  format.parameters.root_guard_bits = 1;
  format.parameters.scaling = Scaling::fixed;
  return format;
}

// Spheres need but few bits in parallel projection: only the constant is rounded.
TEST(QuadricSetUp, ASphereOfTwentyFourBits) {
  const QuadricFormat format = narrow_format();
  const View view = parallel_view(format);
  std::mt19937_64 random(1);
  double worst = 0;
  int covered = 0;
  for (int round = 0; round < 16; ++round) {
    const auto near_middle = [&] { return 256 + static_cast<double>(random() % 1024) / 32 - 16; };
    const double r = 240 - static_cast<double>(random() % 16) / 16;
    const PlacedSolid solid = ball({near_middle(), near_middle(), -256}, glm::dvec3(r));
    const QuadricSetUp result = set_up(solid, view, format);
    ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
    const Seen seen = compare(solid, view, format, result, 3);
    EXPECT_EQ(seen.wrong, "");
    worst = std::max(worst, seen.depth / 32768);
    covered += seen.covered;
    // No pixel further from the outline than 2^-5 / (2 R) is on the wrong side.
    const geometry::ScreenQuadric<double> form = geometry::screen_quadric<double>(solid.quadric, view.screen_to_eye);
    for (std::uint32_t y = 0; y < 512; ++y)
      for (std::uint32_t x = 0; x < 512; ++x) {
        const auto word = quadric_processor::pixel_words(result.words, x, y, format.parameters, 24).discriminant;
        const double d =
            form.discriminant.at(x, y) * std::pow(far_depth(format.words) - near_depth(format.words), 2) * 0x1p-30;
        if ((word >> 23 == 0) != (d >= 0)) {
          EXPECT_LE(std::abs(std::sqrt(r * r - d) - r), 0x1p-5 / (2 * r) * 1.0001);
        }
      }
  }
  std::cout << "sphere, 24 bits: " << worst << " unit of depth at most (bound 0.427), " << covered << " pixels\n";
  EXPECT_LE(worst, 0.427);
  EXPECT_GT(covered, 10000);
}

TEST(QuadricSetUp, AnEllipsoidNeedsMoreBitsThanThat) {
  double narrow = 0, wide = 0, angle = 0;
  int refused = 0;
  std::mt19937_64 random(2);
  for (int round = 0; round < 24; ++round) {
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(uniform(200, 312), uniform(200, 312), -256));
    place = glm::rotate(place, uniform(0, 6), glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), 0.3)));
    place = glm::scale(place, glm::dvec3(uniform(51, 154), uniform(51, 154), uniform(51, 154)));
    const PlacedSolid solid = placed_solid(kSolidShapes[0], place);
    QuadricFormat format = narrow_format();
    const View view = parallel_view(format);
    const QuadricSetUp result = set_up(solid, view, format);
    if (result.outcome == QuadricOutcome::refused) {
      ++refused;
    } else {
      const Seen seen = compare(solid, view, format, result, 3);
      EXPECT_EQ(seen.wrong, "");
      narrow = std::max(narrow, seen.depth / 32768);
    }
    format.parameters = {};
    const QuadricSetUp good = set_up(solid, view, format);
    ASSERT_EQ(good.outcome, QuadricOutcome::drawn) << good.problem.message;
    const Seen seen = compare(solid, view, format, good, 3);
    EXPECT_EQ(seen.wrong, "");
    wide = std::max(wide, seen.depth / 32768);
    angle = std::max(angle, seen.angle);
  }
  std::cout << "ellipsoids: 24 bits " << narrow << " units of depth (" << refused << " refused), by default " << wide
            << ", normals to " << angle * 180 / std::numbers::pi << " degrees\n";
  EXPECT_TRUE(narrow > 5 || refused == 24);
  EXPECT_LT(wide, 0.3);
}

// All kinds on a table, as a camera sees them.
TEST(QuadricSetUp, ATableOfSolidsByDefault) {
  const geometry::Viewport viewport{512, 512};
  const glm::dmat4 to_eye = glm::lookAtRH(glm::dvec3(0, -13, 6.2), glm::dvec3(0, 0, 0.75), glm::dvec3(0, 0, 1));
  const glm::dmat4 clip = glm::perspectiveRH_ZO(30 * std::numbers::pi / 180, 1.0, 4.0, 30.0);
  const View view{viewport, glm::inverse(geometry::eye_to_screen(clip, viewport))};
  const QuadricFormat format = default_format(viewport);
  const auto place = [&](const glm::dvec3& at, const glm::dvec3& size) {
    return glm::scale(glm::translate(to_eye, at), size);
  };
  std::vector<std::pair<const SolidShape*, glm::dmat4>> solids{
      {&kSolidShapes[3], place({0, 0, -0.15}, {4.4, 4.4, 0.15})},
      {&kSolidShapes[6], place({0, 0, 1.2}, {0.7, 0.7, 1.2})},
      {&kSolidShapes[0], place({0, 0, 3.05}, glm::dvec3(0.7))}};
  for (std::size_t i = 0; i < kSolidShapes.size(); ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kSolidShapes.size());
    solids.emplace_back(&kSolidShapes[i], place({3 * std::cos(angle), 3 * std::sin(angle), 0.75}, glm::dvec3(0.6)));
  }
  for (const auto& [shape, to_place] : solids) {
    const PlacedSolid solid = placed_solid(*shape, to_place);
    const QuadricSetUp result = set_up(solid, view, format);
    ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << shape->name << " " << result.problem.message;
    const Seen seen = compare(solid, view, format, result, 1);
    std::cout << shape->name << ": scale " << result.scale << ", depth to " << seen.depth / 32768
              << " units, normals to " << seen.angle * 180 / std::numbers::pi << " degrees, " << seen.uncertain
              << " pixels of " << seen.covered << " within the bound of an outline\n";
    EXPECT_EQ(seen.wrong, "");
    EXPECT_GT(seen.covered, 200);
    EXPECT_LT(seen.depth / 32768, 0.02) << shape->name;
    EXPECT_LT(seen.angle, 0.3 * std::numbers::pi / 180) << shape->name;
    EXPECT_LT(seen.uncertain, 1 + seen.covered / 500) << shape->name;
  }
}

}  // namespace
}  // namespace rastertlm::set_up
