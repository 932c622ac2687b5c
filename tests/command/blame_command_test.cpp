// Does `render --blame` leave what it promises, the same twice, and nothing where it is not asked for?
#include <gmock/gmock.h>

#include <algorithm>

#include "src/image/image_files.h"
#include "src/report/json_report.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class BlameCommandTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("machine.toml", kSmallMachine);
    write("scene.toml", one_triangle());
  }
  Outcome render(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"render", "machine.toml", "scene.toml", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(BlameCommandTest, LeavesATableAChannelAndAPicture) {
  ASSERT_EQ(render("o", {"--blame", "--frames", "2"}).exit_code, 0);
  EXPECT_THAT(file_text(in_work("o/report.txt")), HasSubstr("What made pixels wrong"));
  const report::Contents contents = report::read_json(file_text(in_work("o/report.json")), "report.json");
  ASSERT_EQ(contents.blame.frames.size(), 2U);
  const image::Image channels = image::read_image(in_work("o/frame_0001.exr"));
  const image::Image picture = image::read_image(in_work("o/blame_0001.png"));
  ASSERT_NE(channels.find("blame.step"), nullptr);
  const std::vector<std::uint32_t>& steps = channels.find("blame.step")->u32;
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    wrong += steps[i] != 0 ? 1 : 0;
    const std::uint32_t colour = (std::uint32_t{picture.find("R")->u8[i]} << 16U) +
                                 (std::uint32_t{picture.find("G")->u8[i]} << 8U) + picture.find("B")->u8[i];
    const auto& legend = contents.blame.legend;
    const auto entry = std::find_if(legend.begin(), legend.end(), [&](const auto& e) { return e.value == steps[i]; });
    ASSERT_NE(entry, legend.end()) << steps[i];
    EXPECT_EQ(std::stoul(entry->colour.substr(1), nullptr, 16), colour);
  }
  EXPECT_EQ(wrong, contents.blame.frames[1].wrong);
  EXPECT_GT(wrong, 0U);
}

TEST_F(BlameCommandTest, IsTheSameTwiceAndAgain) {
  ASSERT_EQ(render("a", {"--blame"}).exit_code, 0);
  ASSERT_EQ(render("b", {"--blame"}).exit_code, 0);
  for (const std::string& name : names("a"))
    EXPECT_TRUE(file_text(in_work("a/" + name)) == file_text(in_work("b/" + name))) << name;
  const std::string page = file_text(in_work("a/report.html"));
  ASSERT_EQ(run({"report", "a"}).exit_code, 0);
  EXPECT_TRUE(file_text(in_work("a/report.html")) == page);
}

TEST_F(BlameCommandTest, ChangesNothingElse) {
  ASSERT_EQ(render("with", {"--blame"}).exit_code, 0);
  ASSERT_EQ(render("without", {}).exit_code, 0);
  EXPECT_EQ(names("without").count("blame_0000.png"), 0U);
  EXPECT_TRUE(file_text(in_work("with/frame_0000.png")) == file_text(in_work("without/frame_0000.png")));
  EXPECT_THAT(file_text(in_work("without/report.json")), Not(HasSubstr("blame")));
}

TEST_F(BlameCommandTest, NeedsAnIdealPicture) {
  const Outcome outcome = render("o", {"--blame", "--no-reference"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--blame"));
  EXPECT_EQ(names().count("o"), 0U);
}

}  // namespace
}  // namespace rastertlm::test
