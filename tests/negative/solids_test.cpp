// Who draws triangles alone says so of a scene with a solid, with the solid's place.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

class SolidsTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("scene.toml", one_triangle() + "[[object]]\ntype = \"cylinder\"\nmaterial = \"clay\"\n");
    write("span.toml", "schema = 1\nplatform = \"quadratic\"\n[video]\ncolumns = 64\nlines = 64\n");
    write("adaptive.toml", "schema = 1\nplatform = \"adaptive\"\n[video]\ncolumns = 64\nlines = 64\n");
    write(
        "software.toml",
        "schema = 1\nplatform = \"quadratic\"\n[video]\ncolumns = 64\nlines = 64\n[software]\npreset = \"t800_20\"\n");
    write("machine.toml", kSmallMachine);
  }
  void refused(const std::vector<std::string>& arguments, const std::string& why) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("object[1].type: " + why));
    EXPECT_THAT(outcome.err, HasSubstr("scene.toml:"));
    EXPECT_EQ(outcome.err.find("object[0]"), std::string::npos);
  }
};

TEST_F(SolidsTest, MachinesThatDrawTriangles) {
  for (const char* machine : {"span.toml", "adaptive.toml", "software.toml"})
    refused({"render", machine, "scene.toml", "--out", "o"},
            "this machine draws triangles; solids need quadric processors: platform imogene");
}

TEST_F(SolidsTest, MachinesWithoutQuadricProcessors) {
  const Outcome outcome = run({"render", "machine.toml", "scene.toml", "--out", "o"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("machine.toml: quadric_processor.per_unit: the scene has 1 solid and the machine 0 "
                        "quadric processors"));
}

TEST_F(SolidsTest, BlameAndVectors) {
  refused({"render", "machine.toml", "scene.toml", "--out", "o", "--blame"}, "--blame knows triangles alone");
  refused({"vectors", "machine.toml", "scene.toml", "--out", "o"}, "vectors knows triangles alone");
}

}  // namespace
}  // namespace rastertlm::test
