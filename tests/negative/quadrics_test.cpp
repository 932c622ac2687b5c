// Solids that a quadric processor has its trouble with: each is refused with a sentence, or drawn as the exact picture
// has it. The rules are those of modules/quadric_processor/README.md.
#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

constexpr const char* kCamera = R"(schema = 1
[camera]
eye = [0.0, -10.0, 0.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 0.0, 1.0]
near = 4.0
far = 16.0
)";
constexpr const char* kParallel = "projection = \"orthographic\"\nheight = 6.0\n";
constexpr const char* kPerspective = "projection = \"perspective\"\nvertical_fov_deg = 33.0\n";
constexpr const char* kLit = R"([[light]]
towards = [0.3, -1.0, 0.5]
[[material]]
name = "clay"
[[object]]
material = "clay"
)";
constexpr int kPixels = 64 * 48;

class QuadricsTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", std::string(kSmallMachine) + "[quadric_processor]\nper_unit = 1\ncaps = 3\n");
  }
  Outcome render(const std::string& view, const std::string& object, const std::vector<std::string>& more = {}) {
    write("scene.toml", std::string(kCamera).append(view).append(kLit).append(object));
    std::vector<std::string> arguments{"render", "machine.toml", "scene.toml", "--out", "o"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::filesystem::remove_all(in_work("o"));
    return run(arguments);
  }
  void refused(const std::string& view, const std::string& object, const std::vector<std::string>& texts) {
    const Outcome outcome = render(view, object);
    EXPECT_EQ(outcome.exit_code, 2) << object << outcome.out << outcome.err;
    for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text)) << object;
    EXPECT_FALSE(std::filesystem::exists(in_work("o"))) << object;
  }
  // A number of report.json: of the first such key behind the first key `in`.
  double number(const std::string& in, const std::string& key) const {
    const std::string report = file_text(in_work("o/report.json"));
    const std::size_t list = report.find('"' + in + "\":");
    const std::size_t at = list == std::string::npos ? list : report.find('"' + key + "\":", list);
    if (at == std::string::npos) throw std::out_of_range(key);
    return std::atof(report.c_str() + at + key.size() + 3);
  }
  // Pixels of the first frame; they are those of the exact picture, and their levels nearly. -1: it is refused.
  double covered(const std::string& view, const std::string& object) {
    const Outcome outcome = render(view, object);
    EXPECT_EQ(outcome.exit_code, 0) << object << outcome.err;
    if (outcome.exit_code != 0) return -1;
    EXPECT_EQ(number("error", "covered_missing"), 0) << object;
    EXPECT_EQ(number("error", "covered_extra"), 0) << object;
    EXPECT_LE(number("error", "max_level"), 3) << object;
    return number("images", "covered_pixels");
  }
};

// Both views, where the rule is the same.
const auto kViews = {kParallel, kPerspective};

// A matrix that has no inverse is a cone, a cylinder or planes: drawn as what it is.
TEST_F(QuadricsTest, SingularMatricesAreDrawn) {
  const std::string planes = "type = \"quadric\"\nsquares = [0.0, 0.0, 0.0]\nconstant = 0.0\n";
  const std::string slab = "type = \"quadric\"\nconstant = -1.0\n";
  for (const char* view : kViews) {
    EXPECT_EQ(covered(view, planes + "products = [0.0, 0.0, 1.0]\n"), kPixels / 2);  // x z <= 0
    EXPECT_GT(covered(view, slab + "squares = [1.0, 0.0, 0.0]\n"), 700);             // |x| <= 1
    EXPECT_EQ(covered(view, slab + "squares = [0.0, 1.0, 0.0]\n"), kPixels);
    EXPECT_EQ(covered(view, "type = \"quadric\"\nsquares = [1.0, -1.0, 1.0]\nconstant = 0.0\n"), kPixels);  // a cone
  }
  // Where the planes meet, the normal that the root leaves is short: a few levels in perspective.
  EXPECT_EQ(covered(kParallel, planes + "products = [1.0, 0.0, 0.0]\nrotate_deg = [10.0, 20.0, 30.0]\n"), kPixels);
  EXPECT_EQ(covered(kParallel, slab + "squares = [1.0, 0.0, 0.0]\n"), 16 * 48);
}

TEST_F(QuadricsTest, EverythingIsDrawnAndNothingIsRefused) {
  for (const char* view : kViews) {
    EXPECT_EQ(covered(view, "type = \"quadric\"\nsquares = [-1.0, -1.0, -1.0]\nconstant = -1.0\n"), kPixels);
    for (const char* nothing :
         {"squares = [1.0, 1.0, 1.0]\nconstant = 1.0\n", "squares = [1.0, 1.0, 1.0]\nconstant = 0.0\n",
          "squares = [0.0, 1.0, 0.0]\nconstant = 0.0\n", "squares = [1.0, 0.0, 1.0]\nconstant = 0.0\n"})
      refused(view, std::string("type = \"quadric\"\n") + nothing,
              {"scene.toml:18: object[0].constant: nothing is inside: the polynomial must be below 0 somewhere"});
    refused(view, "type = \"quadric\"\nsquares = [0.0, 0.0, 0.0]\nlinear = [0.0, 0.0, 1.0]\n",
            {"scene.toml:17: object[0].squares: a plane, not a quadric"});
  }
}

// In parallel projection there is no root to take: the disc of its end, or of where the near plane cuts it.
TEST_F(QuadricsTest, ACylinderAlongItsAxisIsADisc) {
  for (const char* end : {"", "capped = false\n", "height = 0.001\n"}) {
    const std::string cylinder = "type = \"cylinder\"\nradius = 1.0\nrotate_deg = [90.0, 0.0, 0.0]\n";
    // 8 pixels a unit: those with their middle in a circle of 8.
    int disc = 0;
    for (int y = -24; y < 24; ++y)
      for (int x = -32; x < 32; ++x) disc += (x + 0.5) * (x + 0.5) + (y + 0.5) * (y + 0.5) <= 64 ? 1 : 0;
    EXPECT_EQ(covered(kParallel, cylinder + end), disc) << end;
    EXPECT_GT(covered(kPerspective, cylinder + end), 200) << end;
  }
  const std::string off = "type = \"cylinder\"\nradius = 1.0\nrotate_deg = [90.01, 0.0, 0.0]\n";
  EXPECT_GT(covered(kParallel, off), 200);
}

TEST_F(QuadricsTest, WhatHasNoRootIsRefusedOrLeftOut) {
  const std::string paraboloid = "type = \"paraboloid\"\nheight = 2.0\nrotate_deg = [90.0, 0.0, 0.0]\n";
  const std::string around = "type = \"sphere\"\nradius = 10.0\n";  // the eye is on it
  for (const auto& [view, object] : {std::pair(kParallel, paraboloid), std::pair(kPerspective, around)}) {
    refused(view, object,
            {"scene.toml:15: object[0]: a solid is seen along its axis, or the eye is on its surface",
             "turned by a little, can be drawn (frame 0); quadric_processor.on_refusal = \"drop\""});
    const Outcome outcome = render(view, object, {"--set", "quadric_processor.on_refusal=drop"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("up to 1 solids a frame cannot be shown by the quadric processors"));
  }
  EXPECT_GT(covered(kPerspective, paraboloid), 200);
  // Nearly so its roots are far away: the word is named, and its width does.
  const std::string nearly = "type = \"paraboloid\"\nheight = 2.0\nrotate_deg = [90.1, 0.0, 0.0]\n";
  refused(
      kParallel, nearly,
      {"quadric_processor.root_integer_bits: is 10; the root of a solid needs 12 bits here",
       "(object[0] of the scene, frame 0); quadric_processor.root_integer_bits = 12 would do",
       "scene.toml:15: object[0]: is the solid that quadric_processor.root_integer_bits is too small for, in frame 0"});
  EXPECT_EQ(render(kParallel, nearly, {"--set", "quadric_processor.root_integer_bits=12"}).exit_code, 0);
}

TEST_F(QuadricsTest, LargerThanTheScreenIsDrawn) {
  for (const char* view : kViews) {
    EXPECT_EQ(covered(view, "type = \"sphere\"\nradius = 5.0\n"), kPixels);
    EXPECT_EQ(covered(view, "type = \"sphere\"\nradius = 20.0\n"), kPixels);  // the near plane cuts it
    EXPECT_EQ(covered(view, "type = \"sphere\"\nradius = 5000.0\ntranslate = [0.0, 5000.0, 0.0]\n"), kPixels);
    EXPECT_EQ(covered(view, "type = \"ellipsoid\"\nradii = [1.0, 1.0, 1000.0]\n"),
              covered(view, "type = \"cylinder\"\ncapped = false\n"));
  }
}

TEST_F(QuadricsTest, AxesOfNothingAndOfABillion) {
  const std::string above = "0 is out of range: it must be above 0 and at most 1000000000 world units";
  refused(kParallel, "type = \"sphere\"\nradius = 0.0\n", {"scene.toml:17: object[0].radius: " + above});
  refused(kParallel, "type = \"ellipsoid\"\nradii = [1.0, 0.0, 1.0]\n", {"scene.toml:17: object[0].radii: " + above});
  refused(kParallel, "type = \"cone\"\nheight = 0.0\n", {"scene.toml:17: object[0].height: " + above});
  refused(kParallel, "type = \"sphere\"\nscale = [1.0, 0.0, 1.0]\n", {"object[0].scale[1]: 0 makes the object flat"});
  for (const char* view : kViews) {
    EXPECT_EQ(covered(view, "type = \"sphere\"\nradius = 1e9\n"), kPixels);  // around it all
    EXPECT_EQ(covered(view, "type = \"ellipsoid\"\nradii = [1.0, 1.0, 1e9]\n"),
              covered(view, "type = \"cylinder\"\ncapped = false\n"));
    EXPECT_GT(covered(view, "type = \"ellipsoid\"\nradii = [1e9, 1.0, 1.0]\nrotate_deg = [10.0, 20.0, 30.0]\n"), 1000);
    EXPECT_GT(covered(view, "type = \"cylinder\"\nheight = 1e9\n"), 300);
  }
  // Its surface is before the eye, and its middle far: no word holds the root from there.
  refused(
      kParallel, "type = \"sphere\"\nradius = 1e9\ntranslate = [0.0, 1e9, 0.0]\n",
      {"machine.toml: quadric_processor.word_bits: is 48; the discriminant of a solid needs 64 bits here, more than "
       "the 60 that there can be"});
  EXPECT_EQ(covered(kPerspective, "type = \"sphere\"\nradius = 1e9\ntranslate = [0.0, 1e9, 0.0]\n"), kPixels);
}

TEST_F(QuadricsTest, PlanesThatLeaveNothing) {
  const auto plane = [](const char* normal, const char* distance) {
    return std::string("[[object.plane]]\nnormal = ").append(normal).append("\ndistance = ").append(distance) + "\n";
  };
  const std::string sphere = "type = \"sphere\"\n";
  for (const char* view : kViews) {
    // Outside of the solid: its processor is parked.
    EXPECT_EQ(covered(view, sphere + plane("[0.0, 0.0, 1.0]", "-2.0")), 0);
    EXPECT_EQ(number("solids", "outside"), 1);
    // Against each other: drawn, without a pixel.
    EXPECT_EQ(covered(view, sphere + plane("[1.0, 0.0, 1.0]", "-0.1") + plane("[-1.0, 0.0, -1.0]", "-0.1")), 0);
    EXPECT_EQ(covered(view, sphere + plane("[0.1, 1.0, 0.1]", "-0.1") + plane("[-0.1, -1.0, -0.1]", "-0.1")), 0);
    EXPECT_THAT(file_text(in_work("o/report.txt")), HasSubstr("shows nothing but the background"));
    refused(view, sphere + plane("[0.0, 0.0, 0.0]", "1.0"), {"object[0].plane[0].normal: has no length"});
  }
}

// Which object it is, counted as --set counts; and the line where it stands.
TEST_F(QuadricsTest, TheObjectThatIsRefusedIsNamed) {
  const std::string ball = "type = \"sphere\"\n";
  const std::string two = ball + "radius = 0.1\n[[object]]\nmaterial = \"clay\"\n" + ball + "radius = 10.0\n";
  const Outcome outcome = render(kPerspective, two, {"--set", "quadric_processor.per_unit=2"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("scene.toml:19: object[1]: a solid is seen along its axis, or the eye"));
  EXPECT_EQ(
      render(kPerspective, two, {"--set", "quadric_processor.per_unit=2", "--set", "object[1].radius=1.0"}).exit_code,
      0);
}

TEST_F(QuadricsTest, APlaneOfNoObject) {
  refused(kParallel, "type = \"sphere\"\n[[plane]]\nnormal = [1.0, 0.0, 0.0]\ndistance = 0.5\n",
          {"scene.toml:17: plane: unknown key 'plane'; known of a list's elements: 'object[].plane', written "
           "[[object.plane]] behind its [[object]]"});
}

TEST_F(QuadricsTest, MorePlanesThanCaps) {
  const std::string plane = "[[object.plane]]\nnormal = [1.0, 0.0, 0.0]\ndistance = 0.5\n";
  const std::string four = "type = \"cylinder\"\n" + plane + plane;
  refused(kParallel, four,
          {"machine.toml:11: quadric_processor.caps: is 3; a solid is cut by 4 planes",
           "quadric_processor.caps = 4 would do",
           "scene.toml:15: object[0]: is the solid that quadric_processor.caps is too small for, in frame 0"});
  EXPECT_EQ(render(kParallel, four, {"--set", "quadric_processor.caps=4"}).exit_code, 0);
  refused(kParallel, four + plane + plane + plane, {"7 planes, its ends counted, more than the 6 that there can be"});
}

}  // namespace
}  // namespace rastertlm::test
