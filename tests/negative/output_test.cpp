// Where the results cannot go, and what is left when a run does not end by itself: nothing.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class OutputTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  static std::vector<std::string> render(const std::string& directory, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"render", "machine.toml", "scene.toml", "--out", directory};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // A run that takes much longer than a test, when it has begun to write.
  pid_t long_run() const {
    const pid_t child = start(render("a/o", {"--frames", "100000", "--no-reference"}));
    const std::string partial = in_work("a/o.partial-" + std::to_string(child));
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(partial + "/frame_0000.exr"); }))
        << file_text(in_folder("stderr"));
    return child;
  }
  const std::set<std::string> inputs_{"machine.toml", "scene.toml"};
};

TEST_F(OutputTest, DirectoryThatIsNotOurs) {
  write("thesis/chapter.tex", "years");
  const Outcome outcome = run(render("thesis"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("thesis: exists and holds no report.json of rastertlm"));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(names("thesis"), std::set<std::string>{"chapter.tex"});
  EXPECT_EQ(names(), (std::set<std::string>{"machine.toml", "scene.toml", "thesis"}));
}

TEST_F(OutputTest, DirectoryWithAnotherReport) {
  write("web/report.json", R"({"schema": 1, "title": "another program's"})");
  EXPECT_EQ(run(render("web")).exit_code, 2);
  EXPECT_EQ(file_text(in_work("web/report.json")), R"({"schema": 1, "title": "another program's"})");
}

TEST_F(OutputTest, File) {
  EXPECT_EQ(run(render("scene.toml")).exit_code, 2);
  EXPECT_EQ(file_text(in_work("scene.toml")), one_triangle());
  EXPECT_EQ(names(), inputs_);
}

TEST_F(OutputTest, OursIsReplaced) {
  ASSERT_EQ(run(render("o", {"--frames", "2"})).exit_code, 0);
  ASSERT_EQ(names("o").count("frame_0001.png"), 1U);
  const Outcome outcome = run(render("o"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(names("o").count("frame_0001.png"), 0U);
}

TEST_F(OutputTest, FolderOfResultsTakesAResultAndKeepsThem) {
  ASSERT_EQ(run(render("out/first")).exit_code, 0);
  const Outcome outcome = run(render("out"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(names("out").count("report.json"), 1U);
  EXPECT_EQ(names("out/first").count("report.json"), 1U);
}

TEST_F(OutputTest, FolderOfResultsAndSomethingElseIsRefused) {
  ASSERT_EQ(run(render("out/first")).exit_code, 0);
  write("out/notes.txt", "mine");
  EXPECT_EQ(run(render("out")).exit_code, 2);
  EXPECT_EQ(names("out"), (std::set<std::string>{"first", "notes.txt"}));
}

TEST_F(OutputTest, Unwritable) {
  for (const char* directory : {"/proc/rastertlm", "scene.toml/o"}) {
    const Outcome outcome = run(render(directory));
    EXPECT_EQ(outcome.exit_code, 4) << directory;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write"));
    EXPECT_THAT(outcome.err, HasSubstr(directory));
  }
  if (::geteuid() != 0) {  // root may write anywhere
    std::filesystem::create_directory(in_work("locked"));
    std::filesystem::permissions(in_work("locked"),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_EQ(run(render("locked/o")).exit_code, 4);
    std::filesystem::permissions(in_work("locked"), std::filesystem::perms::owner_all);
    std::filesystem::remove(in_work("locked"));
  }
  EXPECT_EQ(names(), inputs_);
}

// Wherever the limit strikes, in a picture or in a report, it is an error and leaves nothing.
TEST_F(OutputTest, Full) {
  ASSERT_EQ(run(render("o")).exit_code, 0);
  std::set<std::uintmax_t> sizes;
  for (const auto& entry : std::filesystem::directory_iterator(in_work("o"))) sizes.insert(entry.file_size());
  std::filesystem::remove_all(in_work("o"));
  ASSERT_GT(*sizes.begin(), 1U);
  const std::set<std::string> before = names();
  for (const std::uintmax_t limit : {std::uintmax_t{0}, *sizes.begin() - 1, *sizes.rbegin() / 2, *sizes.rbegin() - 1}) {
    // What the program prints goes to a file too: at limit 0 there is no text.
    const Outcome outcome = run(render("a/o"), limit);
    EXPECT_EQ(outcome.exit_code, 4) << limit << ": " << outcome.err << outcome.signal;
    EXPECT_EQ(names(), before) << limit;
    if (limit > 200) {
      EXPECT_THAT(outcome.err, HasSubstr("File too large")) << limit;
    }
  }
  EXPECT_EQ(run(render("a/o"), *sizes.rbegin() + 100).exit_code, 0);
}

TEST_F(OutputTest, AFailureKeepsTheEarlierResult) {
  ASSERT_EQ(run(render("o")).exit_code, 0);
  const std::string before = file_text(in_work("o/report.json"));
  EXPECT_EQ(run(render("o", {"--frames", "2"}), 300).exit_code, 4);
  EXPECT_EQ(file_text(in_work("o/report.json")), before);
  EXPECT_EQ(names(), (std::set<std::string>{"machine.toml", "scene.toml", "o"}));
}

TEST_F(OutputTest, InterruptLeavesNothing) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const pid_t child = long_run();
    ASSERT_EQ(::kill(child, signal), 0);
    const Outcome outcome = wait_for(child);
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_THAT(outcome.err, HasSubstr("nothing was written"));
    EXPECT_EQ(names(), inputs_) << "nor the directory above";
  }
}

TEST_F(OutputTest, TheNextRunRemovesWhatAKillLeft) {
  const pid_t child = long_run();
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  EXPECT_EQ(wait_for(child).signal, SIGKILL);
  EXPECT_EQ(names("a"), std::set<std::string>{"o.partial-" + std::to_string(child)});
  EXPECT_EQ(run(render("a/o")).exit_code, 0);
  EXPECT_EQ(names("a"), std::set<std::string>{"o"});
}

TEST_F(OutputTest, ARunLeavesAnotherAlone) {
  const pid_t child = long_run();
  EXPECT_EQ(run(render("a/o")).exit_code, 0);
  EXPECT_EQ(names("a"), (std::set<std::string>{"o", "o.partial-" + std::to_string(child)}));
  ASSERT_EQ(::kill(child, SIGTERM), 0);
  EXPECT_EQ(wait_for(child).exit_code, 143);
  EXPECT_EQ(names("a"), std::set<std::string>{"o"});
}

TEST_F(OutputTest, StandardOutputThatIsFull) {
  const Outcome outcome = run({"describe", "parameters"}, 100);
  EXPECT_EQ(outcome.exit_code, 4);
}

}  // namespace
}  // namespace rastertlm::test
