// Pictures that cannot be compared, and maps that cannot be written.
#include <gmock/gmock.h>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class CompareErrors : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("a.ppm", "P6\n2 1\n255\nabcdef");
    write("b.ppm", "P6\n2 1\n255\nghijkl");
    write("wide.ppm", "P6\n3 1\n255\nabcdefghi");
  }
  void expect_failure(const std::vector<std::string>& arguments, int exit_code, const std::string& message) const {
    std::vector<std::string> words{"compare"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, exit_code) << message;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_THAT(outcome.out, IsEmpty()) << message;
  }
};

TEST_F(CompareErrors, BadInput) {
  write("text.png", "no picture");
  expect_failure({"a.ppm", "wide.ppm"}, 2,
                 "wide.ppm: has 3x1 pixels and a.ppm has 2x1: pictures of one size are compared");
  expect_failure({"a.ppm", "missing.png"}, 2, "missing.png: there is no such file");
  expect_failure({"text.png", "a.ppm"}, 2, "text.png: cannot be read as a picture");
  expect_failure({"a.ppm", "b.ppm", "--layer-b", "reference"}, 2, "b.ppm: has no channel reference.R; it has R, G, B");
  expect_failure({"a.ppm"}, 2, "B is required");
}

TEST_F(CompareErrors, BadOptions) {
  for (const std::string number : {"0", "0.5", "1001", "-67", "nan", "near"})
    expect_failure({"a.ppm", "b.ppm", "--pixels-per-degree", number}, 2,
                   '\'' + number + "' is not a number from 1 to 1000");
  expect_failure({"a.ppm", "b.ppm", "--error-map", "map.jpg"}, 2, "'map.jpg' is neither a .png nor an .exr");
  expect_failure({"a.ppm", "b.ppm", "--eror-map", "map.png"}, 2, "--error-map");
  EXPECT_EQ(names(), (std::set<std::string>{"a.ppm", "b.ppm", "wide.ppm"}));
}

TEST_F(CompareErrors, MapsThatCannotBeWritten) {
  expect_failure({"a.ppm", "b.ppm", "--error-map", "a.ppm/map.png"}, 4, "a.ppm");
  ASSERT_EQ(run({"compare", "a.ppm", "b.ppm", "--error-map", "map.png"}).exit_code, 0);
  const std::string before = file_text(in_work("map.png"));
  expect_failure({"map.png", "b.ppm", "--error-map", "./map.png"}, 2, "./map.png is one of the pictures");
  EXPECT_EQ(file_text(in_work("map.png")), before);
}

}  // namespace
}  // namespace rastertlm::test
