// timeline.json, read by a program that shares nothing with the model: events in order and nested, their times and sums
// those of the report.
#include <gmock/gmock.h>

#include "tests/support/browser.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

class TimelineTest : public ProgramTest {
 protected:
  static std::string config(const std::string& name) { return std::string(RASTERTLM_SOURCE_DIR) + "/configs/" + name; }
  void render(const std::string& machine, const std::string& scene, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{
        "render", config("machines/" + machine), config("scenes/" + scene), "--no-reference", "--out", "o"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    // Of what was asked for the name is said.
    EXPECT_EQ(outcome.out.find(", timeline.json\n") != std::string::npos, !more.empty()) << outcome.out;
  }
  void expect_good_timeline(const std::vector<std::string>& lines = {}) const {
    std::vector<std::string> arguments{in_work("o")};
    arguments.insert(arguments.end(), lines.begin(), lines.end());
    const PageOutcome outcome = check_page("check_timeline.py", arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out.substr(0, 4000);
  }
};

TEST_F(TimelineTest, IsNotWrittenUnasked) {
  render("imogene.toml", "teapot.toml", {});
  EXPECT_FALSE(std::filesystem::exists(in_work("o/timeline.json")));
}

TEST_F(TimelineTest, OfTheObjectMachineIsItsReport) {
  render("imogene.toml", "teapot.toml", {"--frames", "3", "--timeline-frames", "0..2"});
  expect_good_timeline();
}

TEST_F(TimelineTest, OfInterlacedVideoWithTablesThatChange) {
  render("imogene_1024_interlaced.toml", "teapot_orbit.toml", {"--frames", "2", "--timeline-frames", "0..9"});
  expect_good_timeline();
}

TEST_F(TimelineTest, OfQuadricBoardsIsTheirReport) {
  render("imogene_quadrics.toml", "solids.toml", {"--frames", "2", "--timeline-frames", "0..1"});
  expect_good_timeline();
  render("imogene_quadrics.toml", "solids.toml",
         {"--frames", "2", "--timeline-frames", "0..1", "--set", "video.interlaced=true", "--set",
          "quadric_processor.alignment=delay"});
  expect_good_timeline();
}

TEST_F(TimelineTest, OfTheQuadraticMachineIsItsReport) {
  render("quadratic.toml", "sphere_168.toml", {"--frames", "3", "--timeline-frames", "0..2"});
  expect_good_timeline();
}

TEST_F(TimelineTest, OfASharedPortAndOfDealtUnits) {
  render("quadratic.toml", "sphere_168.toml",
         {"--frames", "3", "--timeline-frames", "0..2", "--set", "frame_store.scan_out=shared"});
  expect_good_timeline();
  render("quadratic.toml", "sphere_168.toml",
         {"--frames", "3", "--timeline-frames", "0..2", "--set", "span_unit.units=4", "--set",
          "span_unit.share=triangles"});
  expect_good_timeline();
}

TEST_F(TimelineTest, OfSomeLines) {
  render("imogene.toml", "teapot.toml", {"--frames", "2", "--timeline-frames", "1", "--timeline-lines", "10..12"});
  expect_good_timeline({"10", "12"});
}

TEST_F(TimelineTest, RefusesWhatThereIsNot) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--timeline-frames", "2..1"}, "'2..1' is not A..B"},
      {{"--timeline-frames", "1-2"}, "'1-2' is not A..B"},
      {{"--timeline-lines", "..3"}, "'..3' is not A..B"},
      {{"--timeline-frames", "1"}, "begins at 1, and the displayed frames are 0..0"},
      {{"--timeline-lines", "512..600"}, "begins at 512, and the scan lines are 0..511"}};
  for (const auto& [more, text] : cases) {
    std::vector<std::string> arguments{"render", config("machines/imogene.toml"), config("scenes/teapot.toml"), "--out",
                                       "o"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_THAT(outcome.err, testing::HasSubstr(text));
  }
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace rastertlm::test
