// rastertlm vectors, as a user gives it.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class VectorsCommandTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  Outcome vectors(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"vectors", "machine.toml", "scene.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(VectorsCommandTest, HelpNamesItsOptions) {
  EXPECT_THAT(run({"--help"}).out, HasSubstr("vectors"));
  const Outcome help = run({"vectors", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* option : {"MACHINE", "SCENE", "--out", "--frame", "--field", "--set", "--processors"})
    EXPECT_THAT(help.out, HasSubstr(option));
}

TEST_F(VectorsCommandTest, WritesAndSaysWhere) {
  const Outcome outcome = vectors({"--out", "o", "--frame", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, StartsWith("Frame 1: 1 of 32 processors show an object; words of 1 are written.\n"));
  EXPECT_THAT(outcome.out, HasSubstr("o/README.md, manifest.json: "));
  EXPECT_EQ(names(), (std::set<std::string>{"machine.toml", "scene.toml", "o"}));
  EXPECT_EQ(file_text(in_work("o/board0_processor0_material.hex")), "00\n");
  EXPECT_THAT(file_text(in_work("o/decision.csv")),
              StartsWith("line,column,object,depth,normal_x,normal_y,normal_z,material\n0,0,0,16777215,0,0,0,0\n"));
}

TEST_F(VectorsCommandTest, ReadsItsResolvedConfigurationBack) {
  ASSERT_EQ(vectors({"--out", "a", "--set", "decision_unit.topology=pipeline"}).exit_code, 0);
  ASSERT_EQ(run({"vectors", "a/config.resolved.toml", "a/scene.resolved.toml", "--out", "b"}).exit_code, 0);
  for (const std::string& name : names("a")) {
    if (name.find("resolved") != std::string::npos || name == "manifest.json") continue;  // they name their origins
    EXPECT_TRUE(file_text(in_work("a/" + name)) == file_text(in_work("b/" + name))) << name;
  }
}

TEST_F(VectorsCommandTest, ReplacesItsOwnDirectory) {
  ASSERT_EQ(vectors({"--out", "o", "--processors", "0-3"}).exit_code, 0);
  ASSERT_EQ(vectors({"--out", "o", "--processors", "1-1"}).exit_code, 0);
  EXPECT_EQ(names("o").count("board0_processor0_ep0.hex"), 0U);
  ASSERT_EQ(run({"render", "machine.toml", "scene.toml", "--out", "o"}).exit_code, 0);
  EXPECT_EQ(names("o").count("manifest.json"), 0U);
}

TEST_F(VectorsCommandTest, WarnsOfTheCarryThatLosesWords) {
  const Outcome outcome = vectors({"--out", "o", "--set", "ep1.carry_clock=clock2"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("Warning: ep1.carry_clock"));
}

}  // namespace
}  // namespace rastertlm::test
