// Geometry and lights that the tests for highlights and the search for their centres do not like: each by its rule, in
// numbers, and told.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kUsual = "[-2.0, 0.0, -2.0], [2.0, 0.0, -2.0], [0.0, 0.0, 2.0]";
constexpr const char* kBulging = "normals = [[-0.6, -0.8, -0.2], [0.6, -0.8, -0.2], [0.0, -0.8, 0.6]]\n";

class AdaptiveInputTest : public ProgramTest, public testing::WithParamInterface<const char*> {
 protected:
  // On 64 x 64, seen from (0, -10, 0) along y.
  Outcome rendered(const std::string& light, const std::string& positions, const std::string& normals = kBulging,
                   const std::string& settings = "") {
    write("machine.toml", std::string("schema = 1\nplatform = \"adaptive\"\n[video]\ncolumns = 64\nlines = 64\n"
                                      "[set_up]\nmethod = \"") +
                              method() + "\"\n" + settings);
    write("scene.toml",
          "schema = 1\n[camera]\nprojection = \"perspective\"\neye = [0.0, -10.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\n"
          "vertical_fov_deg = 30.0\nnear = 1.0\nfar = 100.0\n[[light]]\n" +
              light +
              "\n[[material]]\nname = \"clay\"\nambient = 0.2\ndiffuse = 0.4\nspecular = 0.4\nexponent = 20\n"
              "[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\npositions = [" +
              positions + "]\n" + normals);
    return run({"render", "machine.toml", "scene.toml", "--out", "o"});
  }
  void drawn(const Outcome& outcome) const {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(figure("not_finite"), "0");
    EXPECT_GT(std::stoi(figure("covered_pixels")), 500);
  }
  std::string method() const { return GetParam(); }
  // Triangles are told apart by it.
  bool classifies() const { return method().find("subdivision") != std::string::npos || method() == "gouraud_phong"; }
  // Of the frame, as report.json has it.
  std::string figure(const std::string& name) const {
    const std::string text = file_text(in_work("o/report.json"));
    const std::string key = '"' + name + "\": ";
    const std::size_t at = text.find(key);
    if (at == std::string::npos) return "none";
    return text.substr(at + key.size(), text.find_first_of(",\n", at) - at - key.size());
  }
  static std::string light_at(const std::string& position) { return "type = \"point\"\nposition = " + position; }
};

// A light in a corner has no direction from there: the corner is on both sides of everything, and is lit by the rest.
TEST_P(AdaptiveInputTest, LightsAtAVertex) {
  drawn(rendered(light_at("[0.0, 0.0, 2.0]"), kUsual));
  EXPECT_EQ(figure("potentially_highlighted"), classifies() ? "1" : "0");
}

// A light behind all faces lights none of them, and no search finds a centre.
TEST_P(AdaptiveInputTest, LightsInsideTheObject) {
  drawn(rendered(light_at("[0.0, 0.3, -0.5]"), kUsual));
  EXPECT_EQ(figure("true_highlight_centres"), "0");
  EXPECT_EQ(figure("highlight_recall"), "null");
}

// The light and the eye at one place: all planes through both are one, every corner is on both sides of H1.
TEST_P(AdaptiveInputTest, LightsAtTheEye) {
  drawn(rendered(light_at("[0.0, -10.0, 0.0]"), kUsual));
  EXPECT_EQ(figure("potentially_highlighted"), classifies() ? "1" : "0");
  EXPECT_EQ(figure("highlight_recall"), classifies() ? "1.0" : "null");
}

// It is a line on the screen.
TEST_P(AdaptiveInputTest, TheEyeInATrianglesPlane) {
  const Outcome outcome =
      rendered(light_at("[3.0, -8.0, 5.0]"), "[-1.0, -2.0, 0.0], [1.0, -2.0, 0.0], [0.0, 3.0, 0.0]");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(figure("degenerate"), "1");
  EXPECT_EQ(figure("covered_pixels"), "0");
}

TEST_P(AdaptiveInputTest, NormalsOfNoLengthAreRefused) {
  const Outcome outcome = rendered(light_at("[3.0, -8.0, 5.0]"), kUsual,
                                   "normals = [[-0.6, -0.8, -0.2], [0.0, 0.0, 0.0], [0.0, -0.8, 0.6]]\n");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("object[0].normals[1]: has no length"));
}

// Half way between opposite normals there is none: ambient light alone.
TEST_P(AdaptiveInputTest, NormalsThatVanishBetweenCorners) {
  drawn(rendered(light_at("[3.0, -8.0, 5.0]"), kUsual,
                 "normals = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]\n"));
}

// H1 holds everywhere on a flat triangle whose plane light, eye and normal lie in: the quadratic has no roots of its
// own.
TEST_P(AdaptiveInputTest, QuadraticsThatVanish) {
  const std::string level = "normals = [[0.0, -1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -1.0, 0.0]]\n";
  drawn(rendered(light_at("[0.0, -5.0, 0.0]"), kUsual, level));
  drawn(rendered("type = \"directional\"\ntowards = [0.0, -1.0, 0.0]", kUsual, level));
}

TEST_P(AdaptiveInputTest, LightsVeryFarAndVeryNear) {
  drawn(rendered(light_at("[1e9, -1e9, 1e9]"), kUsual));
  drawn(rendered(light_at("[0.0, -1e-9, 0.0]"), kUsual));
}

INSTANTIATE_TEST_SUITE_P(All, AdaptiveInputTest,
                         testing::Values("regular_subdivision", "highlight_subdivision", "gouraud_phong", "phong",
                                         "duff", "taylor", "angular"),
                         [](const auto& one) { return std::string(one.param); });

class AdaptiveLimitTest : public ProgramTest {
 protected:
  std::string report_of(const std::vector<std::string>& settings) {
    const std::string configs = RASTERTLM_SOURCE_DIR "/configs/";
    std::vector<std::string> arguments{
        "render",        configs + "machines/adaptive.toml", configs + "scenes/teapot_four_lights.toml", "--out", "o",
        "--no-reference"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file_text(in_work("o/report.txt"));
  }
};

TEST_F(AdaptiveLimitTest, WhatIsCutNoFurtherIsTold) {
  EXPECT_THAT(report_of({"subdivision.depth_limit=1"}),
              ContainsRegex("[0-9]+ triangles are cut no further than subdivision.depth_limit says"));
  EXPECT_THAT(file_text(in_work("o/report.json")), HasSubstr("\"parts_at_grid_limit\": 0,"));
  EXPECT_THAT(report_of({"set_up.method=highlight_subdivision"}),
              ContainsRegex("[0-9]+ triangles are cut no further: highlight subdivision has 16 fraction bits"));
  EXPECT_THAT(report_of({}), Not(HasSubstr("cut no further")));
}

}  // namespace
}  // namespace rastertlm::test
