// report.html of runs, opened in a real browser (tests/pages): what it shows is what the run's files hold, its console
// stays empty and nothing leaves it. Its pictures are kept in the build's artefacts.
#include <gmock/gmock.h>

#include "tests/support/browser.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

constexpr std::uintmax_t kMostBytesOfARun = 3'000'000;

class PagesTest : public ProgramTest {
 protected:
  void expect_good_page(const std::string& directory, const std::string& name) const {
    const PageOutcome outcome = check_page("check_run_page.py", {in_work(directory), RASTERTLM_ARTEFACTS, name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  }
  static std::string config(const std::string& name) { return std::string(RASTERTLM_SOURCE_DIR) + "/configs/" + name; }
};

TEST_F(PagesTest, RunOfTheObjectMachine) {
  const Outcome outcome = run({"render", config("machines/imogene.toml"), config("scenes/teapot.toml"), "--frames", "2",
                               "--blame", "--out", "o"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(std::filesystem::file_size(in_work("o/report.html")), kMostBytesOfARun);
  expect_good_page("o", "run_imogene");
}

TEST_F(PagesTest, RunOfTheQuadraticMachine) {
  const Outcome outcome =
      run({"render", config("machines/quadratic.toml"), config("scenes/sphere_168.toml"), "--out", "o"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(std::filesystem::file_size(in_work("o/report.html")), kMostBytesOfARun);
  expect_good_page("o", "run_quadratic");
}

TEST_F(PagesTest, OfASweep) {
  write("machine.toml", kSmallMachine);
  write("scene.toml", one_triangle());
  write("sweep.toml",
        "schema = 1\nquestion = \"Which?\"\nmachine = \"machine.toml\"\nscene = \"scene.toml\"\n"
        "[[vary]]\npath = \"decision_unit.topology\"\nvalues = [\"tree\", \"pipeline\"]\n"
        "[[vary]]\npath = \"host.preset\"\nvalues = [\"t800_20\", \"t9000\"]\n"
        "[[objective]]\npath = \"answer.headroom\"\nsense = \"maximise\"\n"
        "[[objective]]\npath = \"answer.latency_first_pixel_us\"\nsense = \"minimise\"\n");
  const Outcome swept = run({"explore", "run", "sweep.toml", "--store", "s.sqlite", "--jobs", "1"});
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  const Outcome shown = run({"explore", "show", "s.sqlite", "--html", "sweep.html"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(shown.out, "sweep.html\n");
  const PageOutcome outcome =
      check_page("check_sweep_page.py", {in_work("sweep.html"), RASTERTLM_ARTEFACTS, "sweep_small"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  const std::string before = file_text(in_work("sweep.html"));
  EXPECT_EQ(run({"explore", "show", "s.sqlite", "--html", "/dev/null/sweep.html"}).exit_code, 4);
  constexpr rlim_t kTooSmall = 100'000;
  EXPECT_EQ(run({"explore", "show", "s.sqlite", "--html", "sweep.html"}, kTooSmall).exit_code, 4);
  EXPECT_TRUE(file_text(in_work("sweep.html")) == before) << "what was there stays";
  EXPECT_EQ(names().count("sweep.html"), 1U);
  for (const std::string& name : names()) EXPECT_EQ(name.find("partial"), std::string::npos) << name;
}

// A name that is a script stays a name, in the page and in the file.
TEST_F(PagesTest, NamesAreNoScripts) {
  write("machine.toml", kSmallMachine);
  std::string scene = one_triangle();
  const std::string name = "clay";
  const std::string script = "</script><script>window.intruder = 1</script><img src=x onerror='window.intruder = 2'>";
  for (std::size_t at = scene.find('"' + name + '"'); at != std::string::npos; at = scene.find('"' + name + '"'))
    scene.replace(at + 1, name.size(), script);
  write("scene.toml", scene);
  const Outcome outcome = run({"render", "machine.toml", "scene.toml", "--out", "o"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(file_text(in_work("o/report.html")), testing::Not(testing::HasSubstr(script)));
  EXPECT_THAT(file_text(in_work("o/report.html")), testing::HasSubstr("window.intruder = 1"));
  expect_good_page("o", "run_script_in_a_name");
}

}  // namespace
}  // namespace rastertlm::test
