// Does `compare` print what is known of two pictures, and write where they differ?
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using testing::HasSubstr;

using Levels = std::vector<int>;

class CompareTest : public ProgramTest {
 protected:
  // Of `levels.size() / 3` pixels in a line.
  void write_ppm(const std::string& name, const Levels& levels) const {
    std::string text = "P6\n" + std::to_string(levels.size() / 3) + " 1\n255\n";
    for (const int level : levels) text += static_cast<char>(level);
    write(name, text);
  }
  // What stands in the row of `figure`, blanks as one.
  static std::string row(const Outcome& outcome, const std::string& figure) {
    const std::size_t begin = outcome.out.find(figure + ' ');
    if (begin == std::string::npos) return "no " + figure;
    std::string text;
    for (std::size_t i = begin + figure.size(); i < outcome.out.size() && outcome.out[i] != '\n'; ++i)
      if (outcome.out[i] != ' ' || (!text.empty() && text.back() != ' ')) text += outcome.out[i];
    return text;
  }
};

TEST_F(CompareTest, FiguresByHand) {
  write_ppm("a.ppm", {10, 20, 30, 40, 50, 60, 70, 80, 90, 0, 255, 7});
  write_ppm("b.ppm", {11, 20, 30, 40, 52, 60, 70, 80, 87, 0, 255, 7});
  const Outcome outcome = run({"compare", "a.ppm", "b.ppm"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(row(outcome, "largest difference"), "3 levels");
  EXPECT_EQ(row(outcome, "over one level"), "50 % of pixels");
  EXPECT_EQ(row(outcome, "over two levels"), "25 % of pixels");
  EXPECT_EQ(row(outcome, "RMSE"), "1.08012 levels");  // sqrt(14 / 12)
  EXPECT_EQ(row(outcome, "PSNR"), "47.4613 dB");
  EXPECT_THAT(outcome.out, HasSubstr("4x1 pixels"));
  EXPECT_THAT(outcome.out, HasSubstr("LDR-FLIP at 67 pixels a degree"));
  EXPECT_THAT(outcome.out, HasSubstr("neither picture says"));
}

TEST_F(CompareTest, EqualAndOppositePictures) {
  write_ppm("black.ppm", Levels(30, 0));
  write_ppm("white.ppm", Levels(30, 255));
  const Outcome same = run({"compare", "white.ppm", "white.ppm"});
  EXPECT_EQ(row(same, "PSNR"), "infinite dB");
  EXPECT_EQ(row(same, "FLIP, mean"), "0 0 .. 1");
  EXPECT_EQ(row(same, "CIEDE2000, 99th percentile"), "0 1: just seen");
  const Outcome far = run({"compare", "black.ppm", "white.ppm", "--pixels-per-degree", "20"});
  EXPECT_EQ(row(far, "PSNR"), "0 dB");
  EXPECT_EQ(row(far, "FLIP, 95th percentile"), "0.96738 0 .. 1");
  EXPECT_EQ(row(far, "CIEDE2000, mean"), "100 1: just seen");
  EXPECT_THAT(far.out, HasSubstr("LDR-FLIP at 20 pixels a degree"));
}

// The map is compared with what it should be.
TEST_F(CompareTest, ErrorMaps) {
  write_ppm("a.ppm", {10, 20, 30, 40, 50, 60, 0, 0, 0});
  write_ppm("b.ppm", {11, 20, 28, 40, 43, 60, 0, 0, 200});
  write_ppm("times_32.ppm", {32, 0, 64, 0, 224, 0, 0, 0, 255});
  write_ppm("differences.ppm", {1, 0, 2, 0, 7, 0, 0, 0, 200});
  ASSERT_EQ(run({"compare", "a.ppm", "b.ppm", "--error-map", "maps/map.png"}).exit_code, 0);
  EXPECT_EQ(row(run({"compare", "maps/map.png", "times_32.ppm"}), "PSNR"), "infinite dB");
  ASSERT_EQ(run({"compare", "a.ppm", "b.ppm", "--error-map", "map.exr"}).exit_code, 0);
  EXPECT_EQ(row(run({"compare", "map.exr", "differences.ppm"}), "PSNR"), "infinite dB");
  const std::string bytes = file_text(in_work("map.exr"));
  EXPECT_THAT(bytes, HasSubstr("CIEDE2000"));
  EXPECT_THAT(bytes, HasSubstr("FLIP"));
  ASSERT_EQ(run({"compare", "a.ppm", "b.ppm", "--error-map", "again.exr"}).exit_code, 0);
  EXPECT_EQ(file_text(in_work("again.exr")), bytes);
}

// The first number behind "key": in a report.
double reported(const std::string& report, const std::string& key) {
  const std::string quoted = '"' + key + "\": ";
  const std::size_t at = report.find(quoted);
  return at == std::string::npos ? std::nan("") : std::atof(report.c_str() + at + quoted.size());
}

// What a run writes as PNG and as EXR is the same picture, and its exact picture, which is not rounded, is as far as
// the report says, where no pixel is missing or extra: the rest is black in both.
TEST_F(CompareTest, FramesOfARun) {
  write("machine.toml", kSmallMachine);
  write("scene.toml", one_triangle());
  ASSERT_EQ(run({"render", "machine.toml", "scene.toml", "--out", "o"}).exit_code, 0);
  EXPECT_EQ(row(run({"compare", "o/frame_0000.png", "o/frame_0000.exr"}), "PSNR"), "infinite dB");
  const Outcome exact = run({"compare", "o/frame_0000.exr", "o/frame_0000.exr", "--layer-b", "reference"});
  EXPECT_EQ(exact.exit_code, 0) << exact.err;
  const std::string report = file_text(in_work("o/report.json"));
  ASSERT_EQ(reported(report, "covered_missing") + reported(report, "covered_extra"), 0.0);
  const double part = reported(report, "compared") / (64.0 * 48.0);
  const double wanted = reported(report, "rmse_unrounded_level") * std::sqrt(part);
  EXPECT_GT(wanted, 0.01);
  EXPECT_THAT(exact.out, HasSubstr("of which"));
  const double inside = std::atof(row(exact, "inside").c_str());
  const double silhouettes = std::atof(row(exact, "silhouettes").c_str());
  EXPECT_GT(inside, 0.0);
  EXPECT_GT(silhouettes, 0.0);
  EXPECT_EQ(
      inside + silhouettes + std::atof(row(exact, "highlights").c_str()) + std::atof(row(exact, "background").c_str()),
      64.0 * 48.0);
  EXPECT_NEAR(std::atof(row(exact, "RMSE").c_str()), wanted, 1e-5 * wanted);
}

TEST_F(CompareTest, GreyPictures) {
  write("grey.pgm", std::string("P5\n2 1\n255\n") + static_cast<char>(10) + static_cast<char>(200));
  write_ppm("same.ppm", {10, 10, 10, 200, 200, 200});
  EXPECT_EQ(row(run({"compare", "grey.pgm", "same.ppm"}), "PSNR"), "infinite dB");
}

}  // namespace
}  // namespace rastertlm::test
