// Are image files what was written: values, names, types, bytes; and does every failure say so?
#include "src/image/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "src/base/errors.h"

namespace rastertlm::image {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImageFiles : public testing::Test {
 protected:
  ImageFiles() : directory_(fs::path(testing::TempDir()) / ("rastertlm_image_" + std::to_string(getpid()))) {
    fs::create_directories(directory_);
  }
  ~ImageFiles() override { fs::remove_all(directory_); }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }

 private:
  fs::path directory_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Levels of columns x lines pixels in which no two neighbours are equal, noisy enough not to compress to nothing.
std::vector<std::uint8_t> noise(std::size_t columns, std::size_t lines) {
  std::vector<std::uint8_t> levels(3 * columns * lines);
  std::uint32_t state = 1;
  for (std::uint8_t& level : levels) {
    state = state * 1664525U + 1013904223U;
    level = static_cast<std::uint8_t>(state >> 24);
  }
  return levels;
}

TEST_F(ImageFiles, PngKeepsEveryLevel) {
  std::vector<std::uint8_t> levels(3 * 256 * 3);
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<std::uint8_t>((i / 3 + 85 * (i % 3)) % 256);
  write_png(path("levels.png"), 256, 3, levels);
  const Image image = read_image(path("levels.png"));
  ASSERT_EQ(image.columns, 256U);
  ASSERT_EQ(image.lines, 3U);
  ASSERT_EQ(image.channels.size(), 3U);
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const ReadChannel* channel = image.find(names[c]);
    ASSERT_NE(channel, nullptr);
    ASSERT_EQ(channel->type, ChannelType::u8);
    for (std::size_t i = 0; i < 256 * 3; ++i)
      ASSERT_EQ(channel->u8[i], levels[3 * i + c]) << "pixel " << i << " channel " << c;
  }
}

struct Planes {
  std::vector<float> interleaved;  // X Y Z a pixel
  std::vector<std::uint32_t> object;
  std::vector<float> depth;
  std::size_t columns = 37;
  std::size_t lines = 130;  // more than one block

  Planes() {
    for (std::size_t i = 0; i < columns * lines; ++i) {
      for (int c = 0; c < 3; ++c) interleaved.push_back(std::sin(static_cast<float>(i * 3) + static_cast<float>(c)));
      object.push_back(static_cast<std::uint32_t>(i * 2654435761U));
      depth.push_back(1.0F / static_cast<float>(i + 1));
    }
    // Not representable as float, or scaled if anybody took them for levels.
    object[0] = 0xffffffffU;
    object[1] = 0x01000001U;
    object[2] = 1;
    depth[3] = std::numeric_limits<float>::denorm_min();
    depth[4] = -1e30F;
  }
  std::vector<Channel> channels() const {
    const std::size_t stride = 3 * sizeof(float);
    return {{"N.X", ChannelType::f32, interleaved.data(), stride},
            {"object.id", ChannelType::u32, object.data(), 0},
            {"N.Y", ChannelType::f32, interleaved.data() + 1, stride},
            {"N.Z", ChannelType::f32, interleaved.data() + 2, stride},
            {"Z", ChannelType::f32, depth.data(), 0}};
  }
};

TEST_F(ImageFiles, ExrKeepsFloatsAndIntegersBitForBitByName) {
  const Planes planes;
  write_exr(path("planes.exr"), planes.columns, planes.lines, planes.channels());
  const Image image = read_image(path("planes.exr"));
  ASSERT_EQ(image.columns, planes.columns);
  ASSERT_EQ(image.lines, planes.lines);
  ASSERT_EQ(image.channels.size(), 5U);
  const ReadChannel* object = image.find("object.id");
  ASSERT_NE(object, nullptr);
  ASSERT_EQ(object->type, ChannelType::u32);
  EXPECT_EQ(object->u32, planes.object);
  const ReadChannel* depth = image.find("Z");
  ASSERT_NE(depth, nullptr);
  EXPECT_EQ(depth->f32, planes.depth);
  const char* names[] = {"N.X", "N.Y", "N.Z"};
  for (std::size_t c = 0; c < 3; ++c) {
    const ReadChannel* normal = image.find(names[c]);
    ASSERT_NE(normal, nullptr);
    for (std::size_t i = 0; i < planes.depth.size(); ++i) ASSERT_EQ(normal->f32[i], planes.interleaved[3 * i + c]);
  }
  EXPECT_EQ(image.find("reference.R"), nullptr);
}

TEST_F(ImageFiles, TwoWritesGiveTheSameBytes) {
  const Planes planes;
  const std::vector<std::uint8_t> levels = noise(64, 64);
  write_exr(path("a.exr"), planes.columns, planes.lines, planes.channels());
  write_png(path("a.png"), 64, 64, levels);
  sleep(2);  // a date in a file counts seconds
  write_exr(path("b.exr"), planes.columns, planes.lines, planes.channels());
  write_png(path("b.png"), 64, 64, levels);
  EXPECT_EQ(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
  EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("b.png")));
  EXPECT_GT(bytes_of(path("a.png")).size(), 64U * 64U * 2U);
}

// The text of the OutputError that `action` throws.
template <class Action>
std::string output_error(Action&& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ImageFiles, AMissingDirectoryIsNamedWithTheReason) {
  const std::string where = path("nowhere") + "/a.png";
  const std::string text = output_error([&] { write_png(where, 2, 2, noise(2, 2)); });
  EXPECT_THAT(text, HasSubstr(where));
  EXPECT_THAT(text, HasSubstr("No such file or directory"));
}

TEST_F(ImageFiles, ADirectoryInTheWayIsNamedWithTheReason) {
  fs::create_directory(path("a.exr"));
  const Planes planes;
  const std::string text =
      output_error([&] { write_exr(path("a.exr"), planes.columns, planes.lines, planes.channels()); });
  EXPECT_THAT(text, HasSubstr(path("a.exr")));
  EXPECT_THAT(text, HasSubstr("Is a directory"));
}

TEST_F(ImageFiles, AFullDiskIsReported) {
  const std::string text = output_error([] { write_png("/dev/full", 64, 64, noise(64, 64)); });
  EXPECT_THAT(text, HasSubstr("/dev/full"));
  EXPECT_THAT(text, HasSubstr("No space left on device"));
  EXPECT_TRUE(fs::exists("/dev/full"));
}

// In a child: the limit of a process cannot be raised again by everybody. 0 when the error is as it should be.
int write_within_limit(const std::string& path) {
  const rlimit limit{1000, 1000};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 10;
  const std::string text = output_error([&] { write_png(path, 64, 64, noise(64, 64)); });
  if (text.find(path) == std::string::npos) return 11;
  if (text.find("File too large") == std::string::npos) return 12;
  return fs::exists(path) ? 13 : 0;
}

TEST_F(ImageFiles, AFileSizeLimitIsReportedAndNothingIsLeft) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(write_within_limit(path("limited.png")));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(ImageFiles, TheFileSizeSignalIsPutBack) {
  struct sigaction before = {};
  before.sa_handler = SIG_DFL;
  sigaction(SIGXFSZ, &before, nullptr);
  write_png(path("a.png"), 2, 2, noise(2, 2));
  struct sigaction after = {};
  sigaction(SIGXFSZ, nullptr, &after);
  EXPECT_TRUE(after.sa_handler == SIG_DFL);
}

TEST_F(ImageFiles, WhatIsNoPictureIsRefusedWithItsPath) {
  const auto input_error = [](const std::string& file) -> std::string {
    try {
      read_image(file);
    } catch (const InputError& error) {
      return to_string(error.diagnostics().front());
    }
    return "";
  };
  EXPECT_THAT(input_error(path("none.png")), HasSubstr(path("none.png")));
  EXPECT_THAT(input_error(path("none.png")), HasSubstr("no such file"));
  std::ofstream(path("text.png")) << "this is not a picture";
  EXPECT_THAT(input_error(path("text.png")), HasSubstr("cannot be read as a picture"));
  // A cut EXR: on a cut PNG the library itself loses a string, which the leak sanitizer would report.
  const Planes planes;
  write_exr(path("cut.exr"), planes.columns, planes.lines, planes.channels());
  fs::resize_file(path("cut.exr"), fs::file_size(path("cut.exr")) / 2);
  EXPECT_THAT(input_error(path("cut.exr")), HasSubstr(path("cut.exr")));
}

}  // namespace
}  // namespace rastertlm::image
