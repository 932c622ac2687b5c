// Does a span unit's machine say what it could not do as asked, in words that name what to change?
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class QuadraticWarningTest : public ProgramTest {
 protected:
  // What the report says: of one triangle on a screen of 64 x 64, orthographic, a world unit a pixel, sample (x, y) at
  // (x - 31.5, 31.5 - y).
  std::string report_of(const std::string& machine, const std::string& positions,
                        const std::string& light = "1.0") const {
    write("machine.toml",
          "schema = 1\nplatform = \"quadratic\"\n[video]\ncolumns = 64\nlines = 64\nvertical_retrace_us = 600.0\n" +
              machine);
    write("scene.toml",
          "schema = 1\n[camera]\nprojection = \"orthographic\"\neye = [0.0, -100.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\n"
          "height = 64.0\nnear = 1.0\nfar = 200.0\n[[light]]\ntowards = [0.0, -1.0, 0.0]\nintensity = [" +
              light + ", " + light + ", " + light +
              "]\n[[material]]\nname = \"clay\"\n[[object]]\ntype = \"triangles\"\nmaterial = \"clay\"\n"
              "two_sided = true\npositions = [" +
              positions + "]\nnormals = [[-0.6, -0.8, 0.0], [0.6, -0.8, 0.0], [0.0, -0.8, 0.6]]\n");
    const Outcome outcome = run({"render", "machine.toml", "scene.toml", "--out", "o", "--no-reference"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return file_text(in_work("o/report.txt"));
  }
  const std::string usual_ = "[-20.5, 0.0, -20.5], [20.5, 0.0, -18.0], [0.0, 0.0, 20.0]";
};

TEST_F(QuadraticWarningTest, NothingIsSaidOfATriangleThatIsDrawn) {
  const std::string report = report_of("", usual_);
  for (const char* word : {"may be off by", "in one colour: ", "are drawn in one colour", "split no further",
                           "beyond the levels", "are no numbers"})
    EXPECT_THAT(report, Not(HasSubstr(word)));
}
TEST_F(QuadraticWarningTest, FractionsThatAreTooShort) {
  EXPECT_THAT(report_of("[span_unit]\nfraction_bits = 8\n", usual_),
              ContainsRegex("8 fraction bits may be off by [0-9.]+ levels .*\\(span_unit.fraction_bits\\)"));
}
TEST_F(QuadraticWarningTest, TrianglesThatTheSolverHasNoAnswerFor) {
  EXPECT_THAT(report_of("[set_up]\nsolver = \"published\"\n", "[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 9.0]"),
              HasSubstr("1 triangles are drawn in one colour: the solver had no answer for them"));
}
// A 128th of a pixel high.
TEST_F(QuadraticWarningTest, TrianglesThatAreTooLow) {
  EXPECT_THAT(report_of("[set_up]\nsnap_bits = 8\n", "[-9.5, 0.0, 0.5], [9.5, 0.0, 0.5], [0.5, 0.0, 0.4921875]"),
              HasSubstr("1 triangles lower than 1/64 pixel are drawn in one colour"));
}
TEST_F(QuadraticWarningTest, TrianglesThatAreSplitNoFurther) {
  EXPECT_THAT(report_of("[set_up]\nmethod = \"quadratic_adaptive\"\n[highlight_test]\ndepth_limit = 1\n"
                        "threshold_levels = 0.0\n",
                        usual_),
              HasSubstr("4 triangles are split no further, and off by more than highlight_test.threshold_levels"));
}
// The light is in the viewer's direction: the highlight is where the normal is, inside; all that hold it are split
// once.
TEST_F(QuadraticWarningTest, TrianglesThatStillHoldAHighlight) {
  EXPECT_THAT(report_of("[set_up]\nmethod = \"quadratic_adaptive\"\n[highlight_test]\ndepth_limit = 1\n"
                        "points = \"h1h2\"\n",
                        usual_),
              ContainsRegex("[1-4] triangles are split no further, and may hold a highlight's centre "
                            "\\(highlight_test.depth_limit\\)"));
}
// Six points, three channels each.
TEST_F(QuadraticWarningTest, ColoursBeyondTheLevels) {
  EXPECT_THAT(report_of("", usual_, "100.0"), HasSubstr("18 colours at points are beyond the levels and clamped"));
}
// 10^6 pixels long and one high. From -64 to 127, where it is cut, it lies between lines 30.3 and 31.3 to less than a
// 1000th: the samples of line 31.
TEST_F(QuadraticWarningTest, ASliverCoversItsLine) {
  report_of("", "[-5e5, 0.0, 0.2], [5e5, 0.0, 0.2], [0.0, 0.0, 1.2]");
  EXPECT_THAT(file_text(in_work("o/report.json")), HasSubstr("\"covered_pixels\": 64"));
}

}  // namespace
}  // namespace rastertlm::test
