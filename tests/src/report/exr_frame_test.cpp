#include "src/report/exr_frame.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>

#include "src/image/image_files.h"

namespace rastertlm::report {
namespace {

class ExrFrameTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ =
        (std::filesystem::temp_directory_path() / ("rastertlm_frame_" + std::to_string(::getpid()) + ".exr")).string();
    shown_.resize(2, 1);
    shown_.rgb = {0, 51, 255, 10, 20, 30};
    shown_.depth = {(1U << 24U) - 1, 123};
    shown_.normal = {0.0F, 0.0F, 0.0F, 0.25F, -0.5F, 0.75F};
    shown_.object = {0, 4'000'000'001U};
    shown_.material = {0, 15};
    shown_.coverage = {0, 3};
    exact_.resize(2, 1);
    exact_.rgb.assign({0.0, 51.0, 204.0, 10.25, 20.0, 0.0});
    exact_.region = {frame::Region::silhouettes, frame::Region::highlights};
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::set<std::string> channel_names() const {
    std::set<std::string> names;
    for (const image::ReadChannel& channel : image::read_image(path_).channels) names.insert(channel.name);
    return names;
  }

  std::string path_;
  frame::Frame shown_;
  frame::ExactFrame exact_;
};

using Floats = std::vector<float>;
using Words = std::vector<std::uint32_t>;

TEST_F(ExrFrameTest, HoldsEverythingThatIsKnownOfAPixel) {
  write_exr_frame(path_, shown_, &exact_);
  const image::Image image = image::read_image(path_);
  const auto floats = [&](const char* name) { return image.find(name) == nullptr ? Floats{} : image.find(name)->f32; };
  const auto words = [&](const char* name) { return image.find(name) == nullptr ? Words{} : image.find(name)->u32; };
  EXPECT_EQ(floats("R"), (Floats{0.0F, 10.0F / 255.0F}));
  EXPECT_EQ(floats("G"), (Floats{0.2F, 20.0F / 255.0F}));
  EXPECT_EQ(floats("B"), (Floats{1.0F, 30.0F / 255.0F}));
  EXPECT_EQ(floats("Z"), (Floats{16'777'215.0F, 123.0F})) << "24 bits are exact";
  EXPECT_EQ(floats("N.X"), (Floats{0.0F, 0.25F}));
  EXPECT_EQ(floats("N.Y"), (Floats{0.0F, -0.5F}));
  EXPECT_EQ(floats("N.Z"), (Floats{0.0F, 0.75F}));
  EXPECT_EQ(words("object.id"), (Words{0, 4'000'000'001U})) << "integers are exact";
  EXPECT_EQ(words("material.id"), (Words{0, 15}));
  EXPECT_EQ(words("coverage.count"), (Words{0, 3}));
  EXPECT_EQ(floats("reference.B"), (Floats{0.8F, 0.0F}));
  EXPECT_EQ(floats("reference.R"), (Floats{0.0F, static_cast<float>(10.25 / 255.0)})) << "not rounded to a level";
  EXPECT_EQ(floats("error.R"), (Floats{0.0F, static_cast<float>(-0.25 / 255.0)}));
  EXPECT_EQ(floats("error.B"), (Floats{0.2F, static_cast<float>(30.0 / 255.0)}));
  EXPECT_EQ(words("reference.region"), (Words{3, 2}));
  EXPECT_EQ(channel_names().size(), 17U);
}

TEST_F(ExrFrameTest, HasNoReferenceChannelsWithoutOne) {
  write_exr_frame(path_, shown_, nullptr);
  EXPECT_EQ(channel_names(), (std::set<std::string>{"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "object.id", "material.id",
                                                    "coverage.count"}));
}

TEST_F(ExrFrameTest, HasAChannelOfLabelsAsIntegers) {
  const LabelledPicture labels{"blame.step", "", {0, 6}, {}};
  write_exr_frame(path_, shown_, &exact_, &labels);
  const image::Image image = image::read_image(path_);
  ASSERT_NE(image.find("blame.step"), nullptr);
  EXPECT_EQ(image.find("blame.step")->type, image::ChannelType::u32);
  EXPECT_EQ(image.find("blame.step")->u32, (Words{0, 6}));
}

TEST(LabelledPicture, IsPaintedByItsLegend) {
  const LabelledPicture picture{"", "", {6, 0, 9}, {{0, "", "", "#010203"}, {6, "", "", "#d53cff"}}};
  EXPECT_EQ(painted(picture), (std::vector<std::uint8_t>{213, 60, 255, 1, 2, 3, 0, 0, 0}));
}

}  // namespace
}  // namespace rastertlm::report
