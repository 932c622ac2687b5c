// The same files whatever is simulated, however the nearest object is found, whoever draws which object, and whichever
// variants of its functions the C library picks.
#include <cstdlib>
#include <map>

#include "src/report/json_report.h"
#include "tests/platforms/imogene/scenes.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using Files = std::map<std::string, std::string>;

class IdentityTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("scene.toml",
          scene_of(
              std::string(R"([[object]]
type = "teapot"
material = "glaze"
rotate_deg = [0.0, 0.0, 30.0]
translate = [0.0, 1.0, -1.5]
)") + kSpin + R"([[object]]
type = "uv_sphere"
material = "slate"
two_sided = true
radius = 1.1
translate = [2.6, -2.0, 0.4]
[[object]]
type = "triangles"
material = "glaze"
two_sided = true
positions = [[-300.0, 5.0, -40.0], [200.0, 4.0, -50.0], [20.0, 6.0, 400.0]]
)",
              std::string(kCamera) +
                  "near = 6.9\n[[camera.animation]]\ntype = \"orbit\"\naxis = [0.1, 0.2, 1.0]\ndeg_per_frame = 2.0\n"));
  }

  // The files of a run of two frames on a host that is in time on any number of boards.
  Files render(const std::vector<std::string>& set, const std::vector<std::string>& flags = {}) const {
    const std::string machine = RASTERTLM_SOURCE_DIR "/configs/machines/imogene.toml";
    std::vector<std::string> arguments{"render", machine, "scene.toml", "--out", "out", "--frames", "2"};
    std::vector<std::string> all{"video.columns=160", "video.lines=128", "host.sustained_mflops=50.0",
                                 "host.processors_per_unit=256"};
    all.insert(all.end(), set.begin(), set.end());
    for (const std::string& one : all) {
      arguments.emplace_back("--set");
      arguments.push_back(one);
    }
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    Files files;
    for (const std::string& name : names("out")) files[name] = file_text(in_work("out/" + name));
    EXPECT_GE(files.size(), 8U);
    return files;
  }

  static run::Result result_of(const Files& files) {
    return report::read_json(files.at("report.json"), "report.json").result;
  }

  // Pictures, channels and errors.
  static Files images(const Files& files) {
    Files found;
    for (const auto& [name, bytes] : files)
      if (name.ends_with(".png") || name.ends_with(".exr")) found[name] = bytes;
    EXPECT_GE(found.size(), 4U);
    return found;
  }

  // Compared file by file: a difference names its file, and does not print a picture.
  static void expect_same(const Files& a, const Files& b) {
    EXPECT_EQ(a.size(), b.size());
    for (const auto& [name, bytes] : a) {
      const auto other = b.find(name);
      ASSERT_NE(other, b.end()) << name;
      EXPECT_TRUE(bytes == other->second) << name << " differs";
    }
  }

  // frames.csv without the times of the first and the last pixel, which are the machine's latency.
  static std::string without_times(const Files& files) {
    run::Result result = result_of(files);
    std::string text;
    for (run::FrameFigures& frame : result.frames) {
      frame.first_pixel_ps = frame.last_pixel_ps = 0;
      frame.retrace_slack_cycles = 0;
      run::Result alone;
      alone.frames.push_back(frame);
      text += report::json_text({alone, false});
    }
    return text;
  }
};

TEST_F(IdentityTest, SecondRunGivesTheSameDirectory) { expect_same(render({}), render({})); }

TEST_F(IdentityTest, ModelEverythingChangesNothingButWhatWasModelled) {
  const Files lean = render({});
  const Files everything = render({}, {"--model-everything"});
  for (const auto& [name, bytes] : lean)
    if (name != "report.json" && name != "report.txt" && name != "report.html") {
      EXPECT_TRUE(bytes == everything.at(name)) << name << " differs";
    }
  run::Result a = result_of(lean);
  run::Result b = result_of(everything);
  EXPECT_LT(a.modelled.processors_instantiated, b.modelled.processors_instantiated);
  EXPECT_EQ(b.modelled.processors_instantiated, b.modelled.processors_available);
  EXPECT_LT(a.modelled.lines_evaluated, b.modelled.lines_evaluated);
  EXPECT_EQ(b.modelled.lines_evaluated, b.modelled.lines_total);
  a.modelled = b.modelled = {};
  EXPECT_EQ(report::json_text({a, false}), report::json_text({b, false}));
}

TEST_F(IdentityTest, PipelineAndTreeShowTheSame) {
  const Files tree = render({});
  const Files pipeline = render({"decision_unit.topology=pipeline"});
  expect_same(images(tree), images(pipeline));
  EXPECT_EQ(without_times(tree), without_times(pipeline));
  EXPECT_NE(tree.at("frames.csv"), pipeline.at("frames.csv"));
}

// No two triangles of the scene have the same depth at a pixel, so it does not matter which processor draws which.
TEST_F(IdentityTest, NumberOfBoardsAndAssignmentChangeNoPicture) {
  const Files eight = render({});
  const std::vector<std::vector<std::string>> others{
      {"host.assignment=block"},
      {"host.computation_units=1", "host.processors_per_unit=2048"},
      {"host.computation_units=3", "host.processors_per_unit=600"},
      {"host.computation_units=3", "host.processors_per_unit=600", "host.assignment=block",
       "decision_unit.topology=pipeline"},
  };
  for (const std::vector<std::string>& set : others) {
    SCOPED_TRACE(set.front() + ' ' + set.back());
    expect_same(images(eight), images(render(set)));
  }
}

// The C library picks variants of its functions by processor; without FMA and AVX2 these are other ones. A processor
// that has neither runs the same twice.
TEST_F(IdentityTest, VariantsOfTheCLibraryGiveTheSameDirectory) {
  const Files with = render({});
  ASSERT_EQ(::setenv("GLIBC_TUNABLES",
                     "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX,-AVX512F,-AVX512VL,-AVX512BW,-BMI2,-ERMS,-SSE4_2", 1),
            0);
  const Files without = render({});
  ::unsetenv("GLIBC_TUNABLES");
  expect_same(with, without);
}

}  // namespace
}  // namespace rastertlm::test
