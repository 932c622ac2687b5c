// Solids that have no root, planes along the rays, and each word that is too narrow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "modules/set_up/quadric_set_up.h"
#include "tests/modules/set_up/solid_comparison.h"

namespace rastertlm::set_up {
namespace {

using quadric_processor::CapKeeps;
using quadric_processor::RayPart;
using quadric_processor::Scaling;
using testing::AllOf;
using testing::HasSubstr;

constexpr geometry::Viewport kScreen{64, 48};
constexpr std::size_t kSphere = 0, kCylinder = 3, kCone = 4, kParaboloid = 5;

QuadricFormat default_format() { return {{}, {24, kScreen.columns, kScreen.lines, EdgeForm::snapped}}; }
glm::dmat4 moved(double x, double y, double z) { return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z)); }
QuadricSetUp set_up(const PlacedSolid& solid, const View& view, const QuadricFormat& format) {
  return set_up_quadric<double>(solid.quadric, solid.planes, 0, view.screen_to_eye, format);
}

// What is shown against the solid as rays see it, but on pixels whose middle is within 1/64 pixel of its outline.
void expect_same_coverage(const PlacedSolid& solid, const View& view, const QuadricFormat& format,
                          const QuadricSetUp& result) {
  const QuadricPixelLogic logic(format.parameters, 24, {near_depth(format.words), far_depth(format.words)});
  int covered = 0, differ = 0;
  for (std::uint32_t y = 0; y < kScreen.lines; ++y)
    for (std::uint32_t x = 0; x < kScreen.columns; ++x) {
      const bool shown =
          logic(result.words, quadric_processor::pixel_words(result.words, x, y, format.parameters, 24)).covered;
      bool any = false, all = true;
      for (const double dx : {-1.0 / 64, 0.0, 1.0 / 64})
        for (const double dy : {-1.0 / 64, 0.0, 1.0 / 64}) {
          const auto ray = geometry::pixel_ray(view.screen_to_eye, x + dx, y + dy);
          const bool hit = geometry::first_hit(solid.quadric, solid.planes, ray).has_value();
          any = any || hit;
          all = all && hit;
        }
      covered += shown ? 1 : 0;
      if (any == all && shown != all) ++differ;
    }
  EXPECT_EQ(differ, 0);
  EXPECT_GT(covered, 20);
  EXPECT_LT(covered, static_cast<int>(kScreen.columns * kScreen.lines) - 20);
}

void expect_refused(const QuadricSetUp& result, const std::string& key, const testing::Matcher<std::string>& message) {
  EXPECT_EQ(result.outcome, QuadricOutcome::refused);
  EXPECT_EQ(result.problem.key, key);
  EXPECT_THAT(result.problem.message, message);
  EXPECT_EQ(result.words.discriminant, quadric_processor::parked_quadric(48).discriminant);
}

TEST(QuadricRefusal, MorePlanesThanCaps) {
  PlacedSolid solid = placed_solid(kSolidShapes[kCylinder], moved(0, 0, -6));
  solid.planes.emplace_back(1, 0, 0, 0);
  QuadricFormat format = default_format();
  const QuadricSetUp result = set_up(solid, view_of(true, kScreen), format);
  expect_refused(result, "quadric_processor.caps", AllOf(HasSubstr("is 2"), HasSubstr("3 planes")));
  EXPECT_EQ(result.problem.width, 3);
  PlacedSolid seven = solid;
  seven.planes.resize(7, {1, 0, 0, 0});
  const QuadricSetUp none = set_up(seven, view_of(true, kScreen), format);
  expect_refused(none, "quadric_processor.caps", HasSubstr("more than the 6 that there can be"));
  EXPECT_EQ(none.problem.width, 0);
  format.parameters.caps = 3;
  const QuadricSetUp more = set_up(solid, view_of(true, kScreen), format);
  EXPECT_EQ(more.outcome, QuadricOutcome::drawn);
  EXPECT_EQ(compare(solid, view_of(true, kScreen), format, more, 1).wrong, "");
}

// Face on, thinner and thinner: drawn as it is, or refused, but never as something else.
TEST(QuadricRefusal, FlatterThanDoublesHold) {
  int drawn = 0, refused = 0;
  for (const bool perspective : {true, false})
    for (double thickness = 1e-2; thickness > 1e-12; thickness /= 3) {
      const glm::dmat4 place = glm::scale(moved(0.1, -0.2, -6), glm::dvec3(1.0, 1.0, thickness));
      const PlacedSolid solid = placed_solid(kSolidShapes[kSphere], place);
      const View view = view_of(perspective, kScreen);
      const QuadricSetUp result = set_up(solid, view, default_format());
      if (result.outcome == QuadricOutcome::drawn) {
        expect_same_coverage(solid, view, default_format(), result);
        ++drawn;
      } else {
        expect_refused(result, "", HasSubstr("flat"));
        ++refused;
      }
    }
  EXPECT_GT(drawn, 10);
  EXPECT_GT(refused, 10);
}

// Turned about the axis by any angle, so that what should be 0 is what rounding left.
TEST(QuadricRefusal, ACylinderAlongParallelRaysIsItsOutline) {
  for (const double angle : {0.0, 0.3, 1.1, 2.7}) {
    glm::dmat4 place = moved(0.4, -0.3, -6);
    for (int i = 0; i < 2; ++i) {  // there and back
      const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
      place = glm::rotate(place, i == 0 ? angle : -angle, axis);
    }
    const PlacedSolid solid = placed_solid(kSolidShapes[kCylinder], place);
    const QuadricFormat format = default_format();
    const View view = view_of(false, kScreen);
    const QuadricSetUp result = set_up(solid, view, format);
    ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
    EXPECT_EQ(result.words.part, RayPart::all);
    expect_same_coverage(solid, view, format, result);
  }
}

TEST(QuadricRefusal, AConesTipAtTheEyeIsItsOutline) {
  const PlacedSolid solid = placed_solid(kSolidShapes[kCone], glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1.5, 4)));
  const View view = view_of(true, kScreen);
  const QuadricFormat format = default_format();
  const QuadricSetUp result = set_up(solid, view, format);
  ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
  EXPECT_EQ(result.words.part, RayPart::all);
  expect_same_coverage(solid, view, format, result);
}

TEST(QuadricRefusal, NoRootWhereRaysGoAlongAnAxisOrStartOnTheSurface) {
  const PlacedSolid along = placed_solid(kSolidShapes[kParaboloid], moved(0, 0, -6));
  const QuadricSetUp result = set_up(along, view_of(false, kScreen), default_format());
  expect_refused(result, "", HasSubstr("along its axis"));
  EXPECT_EQ(result.problem.width, 0);
  EXPECT_EQ(set_up(along, view_of(true, kScreen), default_format()).outcome, QuadricOutcome::drawn);
  const PlacedSolid here = placed_solid(kSolidShapes[kSphere], glm::scale(moved(0, 0, -3), glm::dvec3(3.0)));
  expect_refused(set_up(here, view_of(true, kScreen), default_format()), "", HasSubstr("the eye is on its surface"));
}

// Nearly along it, roots are far from what is seen: wider words would do, and by and by none of ours.
TEST(QuadricRefusal, NearlyAlongAnAxisNeedsWiderWords) {
  bool refused = false, beyond = false;
  std::int64_t last = 0;
  for (double angle = 0.5; angle > 1e-5; angle /= 2) {
    const PlacedSolid solid =
        placed_solid(kSolidShapes[kParaboloid], glm::rotate(moved(0, 0, -6), angle, glm::dvec3(1, 0, 0)));
    QuadricFormat format = default_format();
    const View view = view_of(false, kScreen);
    const QuadricSetUp result = set_up(solid, view, format);
    if (result.outcome == QuadricOutcome::drawn) {
      EXPECT_FALSE(refused);
      EXPECT_EQ(compare(solid, view, format, result, 1).wrong, "");
      continue;
    }
    refused = true;
    EXPECT_EQ(result.outcome, QuadricOutcome::refused);
    if (result.problem.width == 0) {
      EXPECT_THAT(result.problem.message, HasSubstr("that there can be"));
      beyond = true;
      continue;
    }
    EXPECT_FALSE(beyond);
    EXPECT_GE(result.problem.width, last) << result.problem.message;
    last = result.problem.width;
  }
  EXPECT_GT(last, 10);
  EXPECT_TRUE(beyond);
}

// Words of 24 bits, 4 of them fraction, without scaling.
TEST(QuadricRefusal, EachWordByItsWidth) {
  const View view = view_of(true, kScreen);
  const PlacedSolid solid =
      placed_solid(kSolidShapes[kCylinder], glm::rotate(moved(0.5, 0, -4), 1.0, glm::dvec3(1, 0.2, 0)));
  QuadricFormat format = default_format();
  format.parameters.scaling = Scaling::fixed;
  format.parameters.word_bits = 18;
  const auto refused = [&](std::int64_t& width, const char* key, const char* what) {
    const QuadricSetUp result = set_up(solid, view, format);
    EXPECT_EQ(result.outcome, QuadricOutcome::refused);
    EXPECT_EQ(result.problem.key, key);
    EXPECT_THAT(result.problem.message, AllOf(HasSubstr("is " + std::to_string(width)), HasSubstr(what),
                                              HasSubstr("needs " + std::to_string(result.problem.width))));
    EXPECT_GT(result.problem.width, width);
    width = result.problem.width - 1;
    EXPECT_EQ(set_up(solid, view, format).problem.key, key);  // a bit less would not do
    ++width;
    EXPECT_EQ(set_up(solid, view, format).outcome, QuadricOutcome::drawn) << key;
  };
  refused(format.parameters.word_bits, "quadric_processor.word_bits", "the discriminant");
  format.parameters.root_integer_bits = 1;
  refused(format.parameters.root_integer_bits, "quadric_processor.root_integer_bits", "the root");
  format.parameters.plane_bits = 25;
  refused(format.parameters.plane_bits, "quadric_processor.plane_bits", "depth");
}

// Planes along the rays, and some that are nearly so.
TEST(QuadricRefusal, PlanesAlongTheRaysKeepASide) {
  for (const bool perspective : {false, true})
    for (const double slope : {0.0, 1e-14, 1e-9, -1e-9, 1e-7}) {
      PlacedSolid solid = placed_solid(kSolidShapes[kSphere], moved(0, 0, -6));
      solid.planes = {{0.8, 0.6, slope, 0.0}};  // through the eye
      const View view = view_of(perspective, kScreen);
      const QuadricFormat format = default_format();
      const QuadricSetUp result = set_up(solid, view, format);
      ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
      if (std::abs(slope) < 1e-7 && !perspective) {
        EXPECT_EQ(result.words.caps[0].keeps, CapKeeps::side) << slope;
      }
      expect_same_coverage(solid, view, format, result);
    }
}

// 80 times from near to far a pixel: 30 bits do not hold its depth over the screen.
TEST(QuadricRefusal, ASteepPlaneIsOneAlongTheRays) {
  for (const double sign : {-1.0, 1.0}) {
    PlacedSolid solid = placed_solid(kSolidShapes[kSphere], moved(0, 0, -6));
    solid.planes = {{0.8, 0.6, sign * 0.125 / (19 * 80), sign * 0.125 * 10.5 / (19 * 80)}};
    const View view = view_of(false, kScreen);
    QuadricFormat format = default_format();
    format.parameters.plane_bits = 30;
    const QuadricSetUp result = set_up(solid, view, format);
    ASSERT_EQ(result.outcome, QuadricOutcome::drawn) << result.problem.message;
    EXPECT_EQ(result.words.caps[0].keeps, CapKeeps::side);
    expect_same_coverage(solid, view, format, result);
    format.parameters.plane_bits = 40;
    const QuadricSetUp wide = set_up(solid, view, format);
    EXPECT_EQ(wide.words.caps[0].keeps, sign > 0 ? CapKeeps::beyond : CapKeeps::before);
    expect_same_coverage(solid, view, format, wide);
  }
}

// Half a unit of each slope a pixel, over half a screen, is more than 1/64 pixel of a plane of 24 bits.
TEST(QuadricRefusal, PlanesAlongTheRaysNeedBitsForThePixel) {
  const View view = view_of(false, {512, 512});
  PlacedSolid solid = placed_solid(kSolidShapes[kSphere], glm::scale(moved(0, 0, -10), glm::dvec3(3.5)));
  solid.planes = {{0.8, 0.6, 0, 0.2}};
  QuadricFormat format{{}, {18, 512, 512, EdgeForm::snapped}};
  format.parameters.plane_bits = 22;
  const QuadricSetUp result = set_up(solid, view, format);
  expect_refused(result, "quadric_processor.plane_bits", HasSubstr("a cap along the rays"));
  format.parameters.plane_bits = result.problem.width;
  const QuadricSetUp wider = set_up(solid, view, format);
  ASSERT_EQ(wider.outcome, QuadricOutcome::drawn);
  EXPECT_EQ(wider.words.caps[0].keeps, CapKeeps::side);
  for (std::uint32_t y = 32; y < 480; ++y)  // the sphere's box
    for (std::uint32_t x = 32; x < 480; ++x) {
      // Pixels from the plane, more than 0 where the solid remains: the screen is 8 wide.
      const double apart = -(0.8 * (x - 255.5) / 64 + 0.6 * (255.5 - y) / 64 + 0.2) * 64;
      const auto at = quadric_processor::pixel_words(wider.words, x, y, format.parameters, 18).caps[0];
      if (std::abs(apart) > 1.0 / 64) {
        ASSERT_EQ(at >= 0, apart > 0) << x << " " << y;
      }
    }
}

TEST(QuadricRefusal, ACapsNormalIsOutwardsAndOfLengthOne) {
  PlacedSolid solid = placed_solid(kSolidShapes[kSphere], moved(0, 0, -6));
  solid.planes = {glm::dvec4(1.2, -0.9, 2.0, 12.0) * 3.0};
  const QuadricSetUp result = set_up(solid, view_of(true, kScreen), default_format());
  ASSERT_EQ(result.outcome, QuadricOutcome::drawn);
  EXPECT_EQ(result.words.caps[0].keeps, CapKeeps::beyond);
  const glm::dvec3 shown = vector_of(result.words.caps[0].normal, 24) / 4194304.0;
  const glm::dvec3 exact = glm::normalize(glm::dvec3(1.2, -0.9, 2.0));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], exact[i], 0x1p-23);
}

TEST(QuadricRefusal, NothingBehindTheEyeOrBesideTheScreenIsDrawn) {
  for (const bool perspective : {false, true})
    for (const glm::dvec3& at :
         {glm::dvec3(0, 0, 6), glm::dvec3(0, 0, -26), glm::dvec3(30, 0, -6), glm::dvec3(0, -30, -6)})
      for (const std::size_t shape : {kSphere, kCylinder, kCone, kParaboloid}) {
        const PlacedSolid solid =
            placed_solid(kSolidShapes[shape], glm::rotate(moved(at.x, at.y, at.z), 1.0, glm::dvec3(1, 0.3, 0)));
        const QuadricSetUp result = set_up(solid, view_of(perspective, kScreen), default_format());
        EXPECT_EQ(result.outcome, QuadricOutcome::outside)
            << kSolidShapes[shape].name << " " << at.x << " " << at.y << " " << at.z << " " << perspective;
      }
}

}  // namespace
}  // namespace rastertlm::set_up
