// What a span unit's machine refuses, and what it draws of triangles that no machine likes.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

constexpr const char* kHead = "schema = 1\nplatform = \"quadratic\"\n[video]\ncolumns = 64\nlines = 64\n";

class QuadraticInputTest : public ProgramTest {
 protected:
  Outcome rendered(const std::string& machine, const std::string& scene) {
    write("machine.toml", kHead + machine);
    write("scene.toml", scene);
    return run({"render", "machine.toml", "scene.toml", "--out", "o", "--no-reference"});
  }
  void refused(const std::string& machine, const std::vector<std::string>& texts) {
    const Outcome outcome = rendered(machine, one_triangle());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err << outcome.out;
    for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text));
  }
  std::string contents(const std::string& name) const { return file_text(in_work(name)); }
  // Orthographic, a world unit a pixel.
  static std::string scene_of(const std::string& objects, const std::string& light = "1.0") {
    return "schema = 1\n[camera]\nprojection = \"orthographic\"\neye = [0.0, -100.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\n"
           "height = 64.0\nnear = 1.0\nfar = 200.0\n[[light]]\ntowards = [0.0, -1.0, 0.0]\nintensity = [" +
           light + ", " + light + ", " + light + "]\n[[material]]\nname = \"clay\"\n" + objects;
  }
  static std::string triangle(const std::string& positions) {
    return "[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\ntwo_sided = true\npositions = [" + positions + "]\n";
  }
};

TEST_F(QuadraticInputTest, WordsThatDoNotHoldTheirFraction) {
  refused("[span_unit]\nfraction_bits = 25\n",
          {"machine.toml:7: span_unit.fraction_bits: ", "at most 22 are accepted"});
}
TEST_F(QuadraticInputTest, DepthThatOverflowsItsRegister) {
  refused("[span_unit]\ndepth_bits = 28\n",
          {"span_unit.depth_fraction_bits: ", "more than the 32 of a depth register; at most 4 are accepted"});
}
TEST_F(QuadraticInputTest, MethodsOfOtherPlatforms) {
  refused("[set_up]\nmethod = \"phong\"\n", {"machine.toml:7: set_up.method: ", "offered by: adaptive"});
  refused("[set_up]\nmethod = \"regular_subdivision\"\n", {"offered by: adaptive"});
}
TEST_F(QuadraticInputTest, InterlacedVideoAndAccessTimes) {
  refused("interlaced = true\n[frame_store]\naccess_ns = 10.00001\n",
          {"video.interlaced: ",
           "frame_store.access_ns: 10.00001 ns is no whole number of picoseconds; the nearest that is accepted is 10"});
}
TEST_F(QuadraticInputTest, FixedFormatsThatItHasNot) {
  refused("[set_up]\narithmetic = \"fixed\"\nfixed_fraction_bits = 30\n",
          {"set_up.fixed_fraction_bits: ", "accepted: 16, 24, 32, 40, 48"});
}
TEST_F(QuadraticInputTest, TrianglesDealtOutOfTheirOrder) {
  refused("[span_unit]\nunits = 2\nshare = \"triangles\"\n[frame_store]\ndepth_test = false\n",
          {"span_unit.share: ", "in their order"});
}
TEST_F(QuadraticInputTest, ColoursThatAreNoNumbers) {
  const Outcome outcome =
      rendered("", scene_of(triangle("[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]"), "nan"));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("intensity"));
}
TEST_F(QuadraticInputTest, VectorsAreOfTheObjectMachine) {
  write("machine.toml", kHead);
  write("scene.toml", one_triangle());
  const Outcome outcome = run({"vectors", "machine.toml", "scene.toml", "--out", "o"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("\"imogene\""));
}

// Dropped, drawn flat, clamped: each by its rule, and told.
TEST_F(QuadraticInputTest, TrianglesWithoutAreaAreDropped) {
  const Outcome outcome = rendered("", scene_of(triangle("[0.01, 0.0, 0.01], [0.02, 0.0, 0.01], [0.01, 0.0, 0.02]")));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(contents("o/report.json"), HasSubstr("\"degenerate\": 1"));
  EXPECT_THAT(contents("o/report.json"), HasSubstr("\"covered_pixels\": 0"));
}
TEST_F(QuadraticInputTest, WhereThePublishedFormulasHaveNoAnswerATriangleIsFlat) {
  const std::string level = triangle("[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]");
  const Outcome outcome = rendered("[set_up]\nsolver = \"published\"\n", scene_of(level));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err + outcome.out, HasSubstr("the solver had no answer"));
  EXPECT_THAT(contents("o/report.json"), HasSubstr("\"flat\": 1"));
  const Outcome exchanged = rendered("[set_up]\nsolver = \"published_swapped\"\n", scene_of(level));
  EXPECT_THAT(contents("o/report.json"), HasSubstr("\"flat\": 0"));
}
TEST_F(QuadraticInputTest, CornersFarAwayAndSliversAreDrawn) {
  const Outcome far = rendered("", scene_of(triangle("[-1e7, 0.0, -1e7], [1e7, 0.0, -1e7], [0.0, 0.0, 1e7]")));
  EXPECT_EQ(far.exit_code, 0) << far.err;
  EXPECT_THAT(contents("o/report.json"), HasSubstr("\"covered_pixels\": 4096"));
  const Outcome sliver = rendered("", scene_of(triangle("[-5e5, 0.0, 0.2], [5e5, 0.0, 0.2], [0.0, 0.0, 1.2]")));
  EXPECT_EQ(sliver.exit_code, 0) << sliver.err;
}
TEST_F(QuadraticInputTest, ColoursBrighterThanFullScaleAreClamped) {
  const Outcome outcome =
      rendered("", scene_of(triangle("[-9.0, 0.0, -9.0], [9.0, 0.0, -8.0], [0.0, 0.0, 9.0]"), "7.0"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err + outcome.out, HasSubstr("beyond the levels and clamped"));
}

}  // namespace
}  // namespace rastertlm::test
