// The sub-commands and options, as a user gives them.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class CommandTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  Outcome render(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"render", "machine.toml", "scene.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(CommandTest, HelpAndVersionAreResults) {
  for (const char* option : {"--help", "--version"}) {
    const Outcome outcome = run({option});
    EXPECT_EQ(outcome.exit_code, 0) << option;
    EXPECT_THAT(outcome.out, HasSubstr("rastertlm"));
    EXPECT_THAT(outcome.err, IsEmpty());
  }
  const Outcome help = run({"render", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* option :
       {"--set", "--frames", "--out", "--require-rate", "--require-psnr", "--model-everything", "--host-figures",
        "--no-reference", "--perceptual", "--pixels-per-degree", "MACHINE", "SCENE"})
    EXPECT_THAT(help.out, HasSubstr(option));
}

TEST_F(CommandTest, RefusesWordsThatItDoesNotKnowAndNamesTheNearest) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"rendr"}, "rastertlm: unknown sub-command 'rendr'; did you mean 'render'?\n"},
      {{"xyzzyxyzzy"},
       "rastertlm: unknown sub-command 'xyzzyxyzzy'; known: render, explore, vectors, stability, certify, report, "
       "compare, "
       "describe\n"},
      {{"render", "machine.toml", "scene.toml", "--frame", "3"}, "did you mean '--frames'?"},
      {{"render", "machine.toml", "scene.toml", "--requir-rate=3"},
       "unknown option '--requir-rate'; did you mean '--require-rate'?"},
      {{"render", "machine.toml", "scene.toml", "more"}, "'more' is one argument too many"},
      {{"describe", "machine"}, "did you mean 'machines'?"},
      {{"--verson"}, "did you mean '--version'?"},
      {{}, "a sub-command is needed:"},
      {{"report"}, "DIR is required"}};
  for (const auto& [arguments, text] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
  EXPECT_EQ(names(), (std::set<std::string>{"machine.toml", "scene.toml"})) << "nothing was rendered";
}

TEST_F(CommandTest, RefusesValuesOfOptions) {
  const std::vector<std::vector<std::string>> cases{{"--frames", "0"},
                                                    {"--frames", "-1"},
                                                    {"--frames", "1.5"},
                                                    {"--frames", "many"},
                                                    {"--frames", "9999999999"},
                                                    {"--require-rate", "nan"},
                                                    {"--require-rate", "0"},
                                                    {"--require-rate", "inf"},
                                                    {"--require-psnr", "x"},
                                                    {"--set", "video.columns"},
                                                    {"--out", ""},
                                                    {"--out"},
                                                    {"--require-psnr", "30", "--no-reference"},
                                                    {"--perceptual", "--no-reference"},
                                                    {"--pixels-per-degree", "67"},
                                                    {"--perceptual", "--pixels-per-degree", "0.5"}};
  for (const auto& arguments : cases) {
    const Outcome outcome = render(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, StartsWith("rastertlm: ")) << testing::PrintToString(arguments);
  }
  EXPECT_EQ(names(), (std::set<std::string>{"machine.toml", "scene.toml"}));
}

TEST_F(CommandTest, WritesTheFilesOfARun) {
  const Outcome outcome = render({"--frames", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty()) << "progress is for terminals";
  EXPECT_THAT(outcome.out, StartsWith("64x48 at 50 Hz: "));
  EXPECT_THAT(outcome.out, HasSubstr("out/scene_machine/report.txt"));
  EXPECT_EQ(names("out"), std::set<std::string>{"scene_machine"});
  EXPECT_EQ(names("out/scene_machine"),
            (std::set<std::string>{"config.resolved.toml", "error_0000.png", "error_0001.png", "frame_0000.exr",
                                   "frame_0000.png", "frame_0001.exr", "frame_0001.png", "frames.csv", "report.html",
                                   "report.json", "report.txt", "scene.resolved.toml"}));
  const std::string report = file_text(in_work("out/scene_machine/report.txt"));
  EXPECT_EQ(report.substr(0, report.find('\n')), outcome.out.substr(0, outcome.out.find('\n'))) << "the same answer";
  EXPECT_THAT(file_text(in_work("out/scene_machine/frame_0000.png")), StartsWith("\x89PNG"));
  EXPECT_THAT(file_text(in_work("out/scene_machine/frame_0000.exr")), StartsWith("\x76\x2f\x31\x01"));
}

TEST_F(CommandTest, WithoutReferenceThereIsNoError) {
  ASSERT_EQ(render({"--no-reference", "--out", "o"}).exit_code, 0);
  EXPECT_EQ(names("o"), (std::set<std::string>{"config.resolved.toml", "frame_0000.exr", "frame_0000.png", "frames.csv",
                                               "report.html", "report.json", "report.txt", "scene.resolved.toml"}));
}

TEST_F(CommandTest, TwoRunsGiveTheSameBytes) {
  ASSERT_EQ(render({"--out", "a", "--frames", "2"}).exit_code, 0);
  ASSERT_EQ(render({"--out", "b", "--frames", "2"}).exit_code, 0);
  ASSERT_EQ(names("a"), names("b"));
  for (const std::string& name : names("a"))
    EXPECT_TRUE(file_text(in_work("a/" + name)) == file_text(in_work("b/" + name))) << name;
}

TEST_F(CommandTest, ModellingEverythingChangesNoPictureAndNoFigure) {
  ASSERT_EQ(render({"--out", "lean"}).exit_code, 0);
  ASSERT_EQ(render({"--out", "all", "--model-everything"}).exit_code, 0);
  for (const char* name : {"frame_0000.png", "frame_0000.exr", "error_0000.png", "frames.csv"})
    EXPECT_TRUE(file_text(in_work(std::string("lean/") + name)) == file_text(in_work(std::string("all/") + name)))
        << name;
  const auto figures = [&](const std::string& directory) {
    const std::string json = file_text(in_work(directory + "/report.json"));
    return json.substr(0, json.find("\"modelled\""));
  };
  EXPECT_EQ(figures("lean"), figures("all"));
}

TEST_F(CommandTest, ReadsBackItsResolvedConfiguration) {
  ASSERT_EQ(
      render({"--out", "a", "--set", "decision_unit.topology=pipeline", "--set", "background=[1, 2, 3]"}).exit_code, 0);
  const Outcome again = run({"render", "a/config.resolved.toml", "a/scene.resolved.toml", "--out", "b"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const char* name : {"frame_0000.png", "frame_0000.exr", "report.json", "report.txt"})
    EXPECT_TRUE(file_text(in_work(std::string("a/") + name)) == file_text(in_work(std::string("b/") + name))) << name;
}

TEST_F(CommandTest, AnOptionSetsAParameter) {
  ASSERT_EQ(render({"--out", "o", "--set", "video.columns=32"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("o/report.txt")), StartsWith("32x48 at 50 Hz: "));
  EXPECT_THAT(file_text(in_work("o/config.resolved.toml")), HasSubstr("columns = 32"));
}

TEST_F(CommandTest, AMissedRequirementIsSaidAndTheResultIsThere) {
  const Outcome rate = render({"--out", "o", "--require-rate", "75"});
  EXPECT_EQ(rate.exit_code, 1);
  EXPECT_THAT(rate.out, HasSubstr("Requirement missed: "));
  EXPECT_THAT(rate.out, HasSubstr("below the required 75 Hz"));
  EXPECT_EQ(names("o").count("report.json"), 1U);
  // 24 triangles whose normals differ at their corners: no arithmetic of 12 bits is exact.
  write("scene.toml",
        std::string(kSceneHead) +
            "[[object]]\ntype = \"uv_sphere\"\nmaterial = \"clay\"\nslices = 4\nstacks = 4\nradius = 3.0\n");
  const Outcome psnr = render({"--out", "o", "--require-psnr", "500"});
  EXPECT_EQ(psnr.exit_code, 1) << psnr.out;
  EXPECT_THAT(psnr.out, HasSubstr("below the required 500 dB"));
  EXPECT_EQ(render({"--out", "o", "--require-rate", "50", "--require-psnr", "10"}).exit_code, 0);
}

TEST_F(CommandTest, TellsOfTheHostOnlyWhenAsked) {
  ASSERT_EQ(render({"--out", "a"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("a/report.json")), Not(HasSubstr("wall_seconds")));
  ASSERT_EQ(render({"--out", "b", "--host-figures"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("b/report.json")), HasSubstr("wall_seconds"));
}

TEST_F(CommandTest, MeasuresWhatTheEyeSeesWhenAsked) {
  ASSERT_EQ(render({"--out", "a"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("a/report.json")), HasSubstr("\"flip_pixels_per_degree\": null"));
  ASSERT_EQ(render({"--out", "b", "--perceptual", "--pixels-per-degree", "30"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("b/report.json")), HasSubstr("\"flip_pixels_per_degree\": 30"));
  EXPECT_THAT(file_text(in_work("b/report.txt")), HasSubstr("at 30 pixels a degree"));
}

// The exact picture of a view is made once: of a still scene one a reference, of one that moves one a frame.
TEST_F(CommandTest, ExactPicturesAreMadeOnceAView) {
  const auto made = [&](const std::string& directory) {
    const std::string report = file_text(in_work(directory + "/report.txt"));
    const std::size_t at = report.find("Exact pictures: ");
    return at == std::string::npos ? "none" : report.substr(at, report.find(" of them", at) - at);
  };
  ASSERT_EQ(render({"--out", "still", "--frames", "3"}).exit_code, 0);
  EXPECT_EQ(made("still"), "Exact pictures: 9 compared with, 3");
  write("scene.toml",
        one_triangle() + "[[object.animation]]\ntype = \"spin\"\naxis = [0.0, 0.0, 1.0]\ndeg_per_frame = 5.0\n");
  ASSERT_EQ(render({"--out", "moving", "--frames", "3"}).exit_code, 0);
  EXPECT_EQ(made("moving"), "Exact pictures: 9 compared with, 9");
}

TEST_F(CommandTest, ReportMakesTheTextsAgain) {
  ASSERT_EQ(render({"--out", "o"}).exit_code, 0);
  const std::string text = file_text(in_work("o/report.txt"));
  const std::string csv = file_text(in_work("o/frames.csv"));
  const std::string page = file_text(in_work("o/report.html"));
  EXPECT_EQ(run({"report", "o"}).out, text);
  std::filesystem::remove(in_work("o/report.txt"));
  write("o/frames.csv", "old");
  write("o/report.html", "old");
  const Outcome again = run({"report", "o/"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, text);
  EXPECT_EQ(file_text(in_work("o/report.txt")), text);
  EXPECT_EQ(file_text(in_work("o/frames.csv")), csv);
  EXPECT_TRUE(file_text(in_work("o/report.html")) == page);
}

TEST_F(CommandTest, ReportRefusesWhatIsNoRun) {
  write("odd/report.json", "{}");
  for (const char* directory : {"none", "odd", "machine.toml"}) {
    const Outcome outcome = run({"report", directory});
    EXPECT_EQ(outcome.exit_code, 2) << directory;
    EXPECT_THAT(outcome.err, HasSubstr("report.json"));
  }
  EXPECT_EQ(names("odd"), std::set<std::string>{"report.json"});
}

TEST_F(CommandTest, DescribesWhatThereIs) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> topics{
      {"parameters", {"machine imogene", "scene", "columns", "computation_units", "vertical_fov_deg"}},
      {"methods", {"deferred_phong", "gouraud", "highlight_subdivision", "imogene"}},
      {"statistics", {"links[].utilisation", "answer.update_rate_hz", "images[].error.psnr_db", "host.wall_seconds"}},
      {"presets", {"host.preset = \"t800_20\"", "T800-20"}},
      {"machines", {"no machine files in configs/machines"}},
      {"scenes", {"no scene files in configs/scenes"}},
      {"sweeps", {"no sweep files in configs/sweeps"}}};
  const Outcome overview = run({"describe"});
  EXPECT_EQ(overview.exit_code, 0);
  for (const auto& [topic, texts] : topics) {
    EXPECT_THAT(overview.out, HasSubstr(topic));
    const Outcome outcome = run({"describe", topic});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string& text : texts) EXPECT_THAT(outcome.out, HasSubstr(text));
  }
}

TEST_F(CommandTest, DescribesTheShippedFiles) {
  std::filesystem::create_directory_symlink(std::string(RASTERTLM_SOURCE_DIR) + "/configs", in_work("configs"));
  EXPECT_THAT(run({"describe", "machines"}).out, HasSubstr("configs/machines/imogene.toml"));
  EXPECT_THAT(run({"describe", "scenes"}).out, HasSubstr("configs/scenes/teapot.toml"));
  EXPECT_THAT(run({"describe", "sweeps"}).out, HasSubstr("configs/sweeps/transputers.toml"));
}

TEST_F(CommandTest, RendersTheShippedTeapotByDefault) {
  std::filesystem::create_directory_symlink(std::string(RASTERTLM_SOURCE_DIR) + "/configs", in_work("configs"));
  const Outcome outcome = run({"render"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("512x512 at 50 Hz: "));
  EXPECT_THAT(file_text(in_work("out/teapot_imogene/report.txt")),
              HasSubstr("896 made, 16 of them of zero area, 0 without a processor."));
}

}  // namespace
}  // namespace rastertlm::test
