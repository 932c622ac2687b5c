// Can every bound of the hard cases fail? Each is seen to hold, and then to break where the words that go into its core
// are not what they should be.
#include "src/analysis/stability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "src/run/input_files.h"
#include "src/scene/animation.h"

namespace rastertlm::analysis {
namespace {

using object_processor::TriangleWords;
using quadric_processor::QuadricWords;
using span_unit::TriangleLoad;

std::string source(const std::string& name) { return std::string(RASTERTLM_SOURCE_DIR) + "/configs/" + name; }

Finding found(const std::string& machine, const std::string& name, const Tampering& tampering,
              const std::vector<std::string>& set = {}) {
  Diagnostics diagnostics;
  run::InputFiles files;
  const run::Inputs inputs =
      files.read_machine_alone(source("machines/" + machine + ".toml"), config::parse_overrides(set, diagnostics));
  diagnostics.throw_if_any();
  const HardCase hard_case = read_hard_case(source("hard_cases/" + name + ".toml"));
  constexpr std::int64_t kTries = 8;
  return examine(hard_case, *inputs.content, 5, kTries, tampering).value();
}

struct Wrong {
  const char* machine;
  const char* hard_case;
  const char* what;  // of the input that must break
  Tampering tampering;
};
std::ostream& operator<<(std::ostream& out, const Wrong& w) { return out << w.machine << ", " << w.hard_case; }

Tampering object_words(std::function<void(TriangleWords&)> change) {
  Tampering tampering;
  tampering.object_words = std::move(change);
  return tampering;
}
Tampering span_load(std::function<void(TriangleLoad&)> change) {
  Tampering tampering;
  tampering.span_load = std::move(change);
  return tampering;
}

Tampering quadric_words(std::function<void(QuadricWords&)> change) {
  Tampering tampering;
  tampering.quadric_words = std::move(change);
  return tampering;
}

// Errors that a pixel can show.
Tampering moved_edge() {
  return object_words([](TriangleWords& words) { words.edges[0].c += 100'000; });
}
Tampering moved_column() {
  return span_load([](TriangleLoad& load) { load.halves[0].start.column += 1; });
}
Tampering moved_depth() {
  return object_words([](TriangleWords& words) { words.depth.c += 300; });
}
Tampering moved_depth_register() {
  return span_load([](TriangleLoad& load) { load.halves[0].registers.start[span_unit::kDepthSet] += 300U << 8; });
}
// Past the end of the word by more than the margin: what is near reads as far.
Tampering wrapped_depth() {
  return object_words([](TriangleWords& words) { words.depth.c -= 1U << 22; });
}
Tampering wrapped_register() {
  return span_load([](TriangleLoad& load) {
    for (span_unit::HalfTriangle& half : load.halves) half.registers.start[span_unit::kDepthSet] -= 1U << 30;
  });
}
Tampering bent_form() {
  Tampering tampering;
  tampering.form = [](set_up::QuadraticForm<double>& form) { form.t2 *= 1 + 1e-9; };
  return tampering;
}
Tampering floored_words() {
  Tampering tampering;
  tampering.colour_word = [](std::uint64_t word) { return word - 1; };
  return tampering;
}
Tampering neighbour(double by) {
  Tampering tampering;
  tampering.neighbours_corner = [by](geometry::ScreenVertex<double>& corner) { corner.x += by; };
  return tampering;
}
Tampering magnified() {
  Tampering tampering;
  tampering.projection = [](glm::dmat4& matrix) { matrix[1][1] *= 1 + 0x1p-49; };
  return tampering;
}
// As a machine that turns an object by a step every frame.
Tampering summed_angle() {
  Tampering tampering;
  tampering.animate = [](const scene::AnimationDescription& animation, std::int64_t frame) {
    scene::AnimationDescription once = animation;
    once.deg_per_frame = 0.0;
    for (std::int64_t i = 0; i < frame; ++i) once.deg_per_frame += animation.deg_per_frame;
    return scene::animate(glm::dmat4(1.0), {once}, 1);
  };
  return tampering;
}
// Every second triangle is a unit nearer than it should be.
Tampering nearer_depth() {
  auto count = std::make_shared<int>(0);
  return object_words([count](TriangleWords& words) { words.depth.c -= static_cast<std::uint32_t>(++*count % 2); });
}

class BrokenSteps : public testing::TestWithParam<Wrong> {};

TEST_P(BrokenSteps, AreSeen) {
  const Wrong& wrong = GetParam();
  EXPECT_TRUE(found(wrong.machine, wrong.hard_case, {}).holds());
  const Finding finding = found(wrong.machine, wrong.hard_case, wrong.tampering);
  EXPECT_FALSE(finding.holds());
  bool seen = false;
  for (const Measurement& m : finding.measurements)
    if (m.what.find(wrong.what) != std::string::npos) {
      seen = true;
      EXPECT_FALSE(m.holds()) << m.what << ": " << m.measured << " of " << m.bound;
    }
  EXPECT_TRUE(seen);
}

INSTANTIATE_TEST_SUITE_P(
    ObjectMachine, BrokenSteps,
    testing::Values(Wrong{"imogene", "triangles_well_shaped", "against the snapped", moved_edge()},
                    Wrong{"imogene", "triangles_well_shaped", "furthest from the side", moved_edge()},
                    Wrong{"imogene", "triangles_at_limits", "against the snapped", moved_edge()},
                    Wrong{"imogene", "triangles_on_samples", "against the snapped", moved_edge()},
                    Wrong{"imogene", "t_junctions", "away from those edges", moved_edge()},
                    Wrong{"imogene", "watertight_fan", "triangles", moved_edge()},
                    Wrong{"imogene", "vertices_on_samples", "triangles", moved_edge()},
                    Wrong{"imogene", "planes_well_shaped", "depth at", moved_depth()},
                    Wrong{"imogene", "planes_well_shaped", "past an end of their word", wrapped_depth()},
                    Wrong{"imogene", "planes_well_shaped", "component of a normal",
                          object_words([](TriangleWords& words) { words.normals[1].a += 1; })},
                    Wrong{"imogene", "planes_sliver", "depth at", moved_depth()},
                    Wrong{"imogene", "depth_ties", "equal depths", nearer_depth()},
                    Wrong{"imogene", "view_partly_off", "furthest from the outline", moved_edge()},
                    Wrong{"imogene", "view_partly_off", "corners on", neighbour(1e-9)},
                    Wrong{"imogene", "view_partly_off", "furthest from the outline", neighbour(1.0)},
                    Wrong{"imogene", "view_narrow", "projection's matrix", magnified()},
                    Wrong{"imogene", "view_orthographic", "depth of a pixel",
                          object_words([](TriangleWords& words) { words.depth.c += 1U << 20; })},
                    Wrong{"imogene", "million_frames", "rotation", summed_angle()}));

// By 2^-8 of the discriminant's range, or its curvature by a place of the word.
Tampering smaller_solid() {
  return quadric_words([](QuadricWords& words) { words.discriminant.v0 -= std::uint64_t{1} << 36; });
}
Tampering larger_solid() {
  return quadric_words([](QuadricWords& words) { words.discriminant.v0 += std::uint64_t{1} << 36; });
}
Tampering bent_solid() {
  return quadric_words([](QuadricWords& words) { words.discriminant.two_a += std::uint64_t{1} << 24; });
}
Tampering nearer_solid() {
  return quadric_words([](QuadricWords& words) { words.middle.c -= 1U << 13; });
}
Tampering turned_solid() {
  return quadric_words([](QuadricWords& words) {
    for (auto& normal : words.normal) normal.c += 1U << 16;
  });
}
// What a root of one bit less, or one that is read as half of it, would show.
Tampering halved_root() {
  return quadric_words([](QuadricWords& words) { --words.root_shift; });
}
Tampering moved_cut() {
  return quadric_words([](QuadricWords& words) {
    for (auto& cap : words.caps) cap.plane.c += 1U << 20;
  });
}

INSTANTIATE_TEST_SUITE_P(
    Solids, BrokenSteps,
    testing::Values(Wrong{"imogene_quadrics", "solids", "not covered though", smaller_solid()},
                    Wrong{"imogene_quadrics", "solids", "beside the solid", larger_solid()},
                    Wrong{"imogene_quadrics", "solids", "deeper or nearer", nearer_solid()},
                    Wrong{"imogene_quadrics", "solids", "surface that is shown", nearer_solid()},
                    Wrong{"imogene_quadrics", "solids", "normal of a root", turned_solid()},
                    Wrong{"imogene", "solids", "surface that is shown", halved_root()},
                    Wrong{"imogene_quadrics", "solids_spheres", "not covered though", smaller_solid()},
                    Wrong{"imogene_quadrics", "solids_thin", "beside the solid", larger_solid()},
                    Wrong{"imogene_quadrics", "solids_near", "surface that is shown", halved_root()},
                    Wrong{"imogene_quadrics", "solids_along_axis", "deeper or nearer", moved_cut()},
                    Wrong{"imogene_quadrics", "solids_caps_along_rays", "deeper or nearer", moved_cut()},
                    Wrong{"imogene_quadrics", "solids_saddles", "surface that is shown", halved_root()},
                    Wrong{"imogene_quadrics", "solids_near_wrap", "beside the solid", bent_solid()}));

INSTANTIATE_TEST_SUITE_P(
    SpanMachines, BrokenSteps,
    testing::Values(Wrong{"quadratic", "triangles_well_shaped", "against the snapped", moved_column()},
                    Wrong{"quadratic", "triangles_level", "furthest from the side", moved_column()},
                    Wrong{"quadratic", "watertight_fan", "triangles", moved_column()},
                    Wrong{"adaptive", "vertices_on_samples", "triangles", moved_column()},
                    Wrong{"quadratic", "t_junctions", "away from those edges", moved_column()},
                    Wrong{"quadratic", "planes_at_limits", "depth at", moved_depth_register()},
                    Wrong{"quadratic", "planes_well_shaped", "past an end of their word", wrapped_register()},
                    Wrong{"quadratic", "view_near_plane", "furthest from the outline", moved_column()},
                    Wrong{"quadratic", "start_edge", "colours",
                          span_load([](TriangleLoad& load) { load.halves[0].registers.pixel_step[1] += 1U << 12; })},
                    Wrong{"adaptive", "colour_wrap", "colours",
                          span_load([](TriangleLoad& load) { load.halves[0].registers.start[0] += 8; })},
                    Wrong{"quadratic", "forward_differences", "2048 steps, 20", floored_words()},
                    Wrong{"quadratic", "solver_sliver_1e3", "triangles", bent_form()},
                    Wrong{"adaptive", "solver_level_edge", "triangles", bent_form()}));

// Whatever else the machine is.
TEST(Stability, EveryMachineOfTheRepositoryHolds) {
  for (const auto& file : std::filesystem::directory_iterator(source("machines")))
    for (const char* name : {"depth_ties", "depth_crossing", "planes_well_shaped", "view_partly_off"}) {
      const std::string machine = file.path().stem().string();
      EXPECT_TRUE(found(machine, name, {}).holds()) << machine << ", " << name;
    }
}

// A wrong parameter names itself.
TEST(Stability, WithoutADepthTestTheLastIsSeen) {
  for (const char* name : {"depth_ties", "depth_crossing"}) {
    const Finding finding = found("quadratic", name, {}, {"frame_store.depth_test=false"});
    EXPECT_FALSE(finding.holds()) << name;
    EXPECT_EQ(finding.step, "frame_store.depth_test");
  }
}

// One of two is 2^16 units further than it should be.
TEST(Stability, CrossingPlanesAreApartByNoMoreThanTheirErrors) {
  EXPECT_TRUE(found("imogene", "depth_crossing", {}).holds());
  auto count = std::make_shared<int>(0);
  const Finding finding =
      found("imogene", "depth_crossing",
            object_words([count](TriangleWords& words) { words.depth.c += ++*count % 2 == 0 ? 0U : 1U << 16; }));
  EXPECT_FALSE(finding.holds()) << finding.measurements[0].measured << " of " << finding.measurements[0].bound;
}

// Edges with scales of their own: near the triangle by their own bound, and only that.
TEST(Stability, ScaledEdgesAreWithinTheirDisplacement) {
  const std::vector<std::string> scaled{"object_processor.edges=scaled"};
  for (const char* name : {"triangles_well_shaped", "triangles_sliver_1e6", "triangles_at_limits", "view_near_plane"})
    EXPECT_TRUE(found("imogene", name, {}, scaled).holds()) << name;
  const Finding moved = found("imogene", "triangles_well_shaped", moved_edge(), scaled);
  EXPECT_FALSE(moved.holds()) << moved.measurements[0].measured << " of " << moved.measurements[0].bound;
  // A thousand lines that should meet at one vertex do not.
  const Finding fan = found("imogene", "watertight_fan", {}, scaled);
  EXPECT_FALSE(fan.holds());
  EXPECT_EQ(fan.measurements[0].kind, BoundKind::required);
  EXPECT_EQ(fan.step, "object_processor.edges");
}

// T-junctions are said to be what they are.
TEST(Stability, TJunctionsAreNamedAndTheirPixelsCounted) {
  const Finding finding = found("imogene", "t_junctions", {});
  ASSERT_EQ(finding.notes.size(), 1U);
  EXPECT_THAT(finding.notes[0], testing::HasSubstr("T-junction: 8 vertices"));
  EXPECT_GT(finding.measurements[0].measured, 0.0);
}

// In fixed point, where nothing was said before: a bound, or that there is none.
TEST(Stability, FixedPointHasABoundOrSaysThatThereIsNone) {
  for (const char* bits : {"16", "24", "32", "40", "48"}) {
    const std::vector<std::string> set{"set_up.arithmetic=fixed",
                                       std::string("set_up.fixed_fraction_bits=").append(bits)};
    for (const char* name : {"solver_level_edge", "solver_near_level_edge", "solver_tiny", "solver_huge"}) {
      const Finding finding = found("quadratic", name, {}, set);
      EXPECT_TRUE(finding.holds()) << name << ", " << bits;
      EXPECT_FALSE(finding.measurements.empty() && finding.notes.empty());
    }
  }
  EXPECT_FALSE(
      found("quadratic", "solver_level_edge", {}, {"set_up.arithmetic=fixed", "set_up.solver=published"}).holds());
  EXPECT_THAT(found("quadratic", "solver_huge", {}, {"set_up.arithmetic=fixed", "set_up.fixed_fraction_bits=48"}).notes,
              testing::ElementsAre(testing::HasSubstr("nothing is proved of 8 of 8 triangles")));
}

// The bound is of the machine's own numbers: it is not met by the next smaller ones.
TEST(Stability, BoundsFollowTheNumbers) {
  const auto bound = [](const std::string& set) {
    return found("quadratic", "solver_sliver_1e3", {}, {set}).measurements.at(0).bound;
  };
  EXPECT_GT(bound("set_up.arithmetic=float"), 1e6 * bound("set_up.arithmetic=double"));
}

}  // namespace
}  // namespace rastertlm::analysis
