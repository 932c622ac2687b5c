// rastertlm vectors given what it cannot do: the exit code, a sentence that says what is wrong, and nothing left.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class BadVectorsTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  void refused(const std::vector<std::string>& arguments, const std::vector<std::string>& texts, int exit_code = 2,
               std::optional<rlim_t> file_size = std::nullopt) {
    const std::set<std::string> before = names();
    std::vector<std::string> words{"vectors"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(words, file_size);
    EXPECT_EQ(outcome.exit_code, exit_code) << testing::PrintToString(arguments) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    for (const std::string& text : texts) EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(names(), before) << "nothing is written";
  }
  void given(std::vector<std::string> more, const std::vector<std::string>& texts, int exit_code = 2) {
    more.insert(more.begin(), {"machine.toml", "scene.toml"});
    refused(more, texts, exit_code);
  }
};

TEST_F(BadVectorsTest, Usage) {
  given({}, {"--out is required"});
  given({"--out"}, {"--out"});
  given({"--out", ""}, {"--out: it is empty"});
  given({"--out", "o", "--frames", "3"}, {"unknown option '--frames'; did you mean '--frame'?"});
  given({"--out", "o", "more"}, {"'more' is one argument too many"});
  given({"--out", "o", "--set", "video.columns"}, {"video.columns"});
}

TEST_F(BadVectorsTest, FrameOutOfRange) {
  for (const char* frame : {"-1", "1.5", "many", "1000000", "99999999999999999999"})
    given({"--out", "o", "--frame", frame}, {"--frame: ", "is not a whole number from 0 to 999999"});
  // A frame that lies beyond the time that can be simulated.
  given({"--out", "o", "--frame", "999999", "--set", "video.refresh_hz=0.01"}, {"46 days"});
}

TEST_F(BadVectorsTest, Field) {
  for (const char* field : {"2", "-1", "odd"}) given({"--out", "o", "--field", field}, {"--field: ", "is neither 0"});
  given({"--out", "o", "--field", "1"}, {"--field: a frame of this machine has no fields: video.interlaced is false"});
}

TEST_F(BadVectorsTest, Processors) {
  for (const char* range : {"3", "3-", "-3", "4-3", "a-b", "0-1-2", " 0-1", "0.0-1"})
    given({"--out", "o", "--processors", range}, {"is not FROM-TO"});
  given({"--out", "o", "--processors", "0-32"}, {"--processors: there is no processor 32: the machine has 32"});
}

// One large triangle a processor would be 131,080 files.
TEST_F(BadVectorsTest, MoreProcessorsThanAreWrittenAtOnce) {
  write("scene.toml", std::string(kSceneHead) + "[camera]\nprojection = \"orthographic\"\nheight = 8.0\n" +
                          "[[object]]\ntype = \"uv_sphere\"\nmaterial = \"clay\"\ntwo_sided = true\n"
                          "slices = 100\nstacks = 100\nradius = 3.0\n");
  given({"--out", "o", "--set", "host.processors_per_unit=5000", "--set", "video.columns=512", "--set",
         "video.lines=512"},
        {"--processors: processors 0 to 19999 hold", "objects, of eight files each; at most 16384 are written at once",
         "FROM-TO"});
}

TEST_F(BadVectorsTest, MissingFiles) {
  refused({"none.toml", "neither.toml", "--out", "o"}, {"none.toml: ", "neither.toml: ", "no such file"});
}

TEST_F(BadVectorsTest, WhatTheMachineCannotShow) {
  given({"--out", "o", "--set", "object_processor.word_bits=8"}, {"object_processor.word_bits"});
  given({"--out", "o", "--set", "material[0].exponent=3"}, {"3 is not in the path ROM"});
}

TEST_F(BadVectorsTest, WhereTheyCannotGo) {
  for (const char* directory : {"/proc/rastertlm", "scene.toml/o"})
    given({"--out", directory}, {"cannot write", directory}, 4);
  given({"--out", "scene.toml"}, {"scene.toml: is not a directory"});
  write("web/manifest.json", R"({"schema": 1, "name": "an app"})");
  given({"--out", "web"}, {"web: exists and holds no report.json of rastertlm and no manifest.json of its vectors"});
  EXPECT_EQ(names("web"), std::set<std::string>{"manifest.json"});
}

TEST_F(BadVectorsTest, Full) {
  for (const rlim_t limit : {200U, 3000U, 50'000U})
    refused({"machine.toml", "scene.toml", "--out", "o"}, {"cannot write", "File too large"}, 4, limit);
}

TEST_F(BadVectorsTest, InterruptLeavesNothing) {
  const std::set<std::string> before = names();
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
    const pid_t child = start({"vectors", "machine.toml", "scene.toml", "--out", "a/o", "--frame", "999999"});
    const std::string partial = in_work("a/o.partial-" + std::to_string(child));
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(partial); })) << file_text(in_folder("stderr"));
    ASSERT_EQ(::kill(child, signal), 0);
    const Outcome outcome = wait_for(child);
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_THAT(outcome.err, HasSubstr("nothing was written"));
    EXPECT_EQ(names(), before);
  }
}

}  // namespace
}  // namespace rastertlm::test
