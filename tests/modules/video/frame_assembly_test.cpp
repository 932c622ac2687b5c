// Do lines reach their place in the frame, and do the observers' planes show what was seen there and nothing else?
#include "modules/video/frame_assembly.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rastertlm::video {
namespace {

constexpr std::uint32_t kNothing = 0xFFFFFF;
constexpr std::size_t kColumns = 4;
constexpr std::size_t kLines = 3;

FrameAssembly assembly(bool observe = true) {
  return FrameAssembly(
      {.columns = kColumns, .lines = kLines, .normal_bits = 12, .background_depth = kNothing, .observe = observe});
}

frame::RgbLine levels(std::uint8_t first) {
  frame::RgbLine line;
  line.resize(kColumns);
  for (std::size_t i = 0; i < line.levels.size(); ++i) line.levels[i] = static_cast<std::uint8_t>(first + i);
  return line;
}

// Pixels 1 and 2 covered, an object in pixel 1 alone; every word outside is rubbish.
frame::FragmentLine fragments() {
  frame::FragmentLine line;
  line.resize(kColumns);
  for (std::size_t x = 0; x < kColumns; ++x) {
    line.depth[x] = 77;
    line.object[x] = 99;
    line.material[x] = 55;
    line.coverage[x] = 33;
    line.normal_x[x] = line.normal_y[x] = line.normal_z[x] = 0x123;
  }
  line.begin = 1;
  line.end = 3;
  line.depth[1] = 4711;
  line.object[1] = 8;
  line.material[1] = 3;
  line.coverage[1] = 2;
  line.normal_x[1] = 0x800 | 100;  // -(100 + 1/2)
  line.normal_y[1] = 0;            // the interval of zero: +1/2
  line.normal_z[1] = 2000;         // 2000 + 1/2
  line.object[2] = 0;
  line.coverage[2] = 0;
  return line;
}

TEST(FrameAssembly, PutsLinesWhereTheyBelong) {
  FrameAssembly frame = assembly();
  const frame::FragmentLine nothing = [] {
    frame::FragmentLine line;
    line.resize(kColumns);
    return line;
  }();
  for (const std::size_t line : {2U, 0U, 1U})
    frame.add_line(line, levels(static_cast<std::uint8_t>(20 * line)), nothing);
  for (std::size_t line = 0; line < kLines; ++line)
    for (std::size_t i = 0; i < 3 * kColumns; ++i)
      EXPECT_EQ(frame.frame().rgb[3 * kColumns * line + i], 20 * line + i) << line << " " << i;
  EXPECT_FALSE(frame.ends_field(0));
  EXPECT_FALSE(frame.ends_field(1));
  EXPECT_TRUE(frame.ends_field(2));
  EXPECT_EQ(frame.field(2), 0U);
}

// Even lines, then odd ones: a field ends with the last line of its parity, and leaves the other's lines as they were.
TEST(FrameAssembly, WeavesTwoFields) {
  FrameAssembly frame({.columns = kColumns, .lines = 4, .fields = 2});
  frame::FragmentLine nothing;
  nothing.resize(kColumns);
  const std::vector<std::size_t> order{0, 2, 1, 3};
  for (std::size_t pass = 0; pass < 2; ++pass)
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t line = order[i];
      frame.add_line(line, levels(static_cast<std::uint8_t>(40 * pass + 10 * line)), nothing);
      EXPECT_EQ(frame.ends_field(line), i == 1 || i == 3) << line;
      EXPECT_EQ(frame.field(line), i / 2) << line;
      if (pass == 1 && i == 1) {
        EXPECT_EQ(frame.frame().rgb[3 * kColumns * 1], 10);  // of the first frame
        EXPECT_EQ(frame.frame().rgb[3 * kColumns * 2], 60);
      }
    }
  for (std::size_t line = 0; line < 4; ++line) EXPECT_EQ(frame.frame().rgb[3 * kColumns * line], 40 + 10 * line);
}

TEST(FrameAssembly, ObserversSeeObjectsAndBackground) {
  FrameAssembly frame = assembly();
  frame.add_line(1, levels(0), fragments());
  const frame::Frame& seen = frame.frame();
  const std::size_t row = kColumns;
  EXPECT_EQ(seen.depth[row + 1], 4711U);
  EXPECT_EQ(seen.object[row + 1], 8U);
  EXPECT_EQ(seen.material[row + 1], 3U);
  EXPECT_EQ(seen.coverage[row + 1], 2U);
  // (-201, 1, 4001) / 2, of unit length.
  const double length = std::sqrt(201.0 * 201 + 1 + 4001.0 * 4001);
  EXPECT_FLOAT_EQ(seen.normal[3 * (row + 1)], static_cast<float>(-201 / length));
  EXPECT_FLOAT_EQ(seen.normal[3 * (row + 1) + 1], static_cast<float>(1 / length));
  EXPECT_FLOAT_EQ(seen.normal[3 * (row + 1) + 2], static_cast<float>(4001 / length));
  for (const std::size_t x : {0U, 2U, 3U}) {
    EXPECT_EQ(seen.depth[row + x], kNothing) << x;
    EXPECT_EQ(seen.object[row + x], 0U) << x;
    EXPECT_EQ(seen.material[row + x], 0U) << x;
    EXPECT_EQ(seen.coverage[row + x], 0U) << x;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(seen.normal[3 * (row + x) + c], 0.0F) << x;
  }
}

// The planes are written again for every frame: what the last one showed is gone.
TEST(FrameAssembly, ForgetsTheLastFrame) {
  FrameAssembly frame = assembly();
  frame.add_line(0, levels(0), fragments());
  frame::FragmentLine nothing;
  nothing.resize(kColumns);
  frame.add_line(0, levels(100), nothing);
  EXPECT_EQ(frame.frame().object[1], 0U);
  EXPECT_EQ(frame.frame().depth[1], kNothing);
  EXPECT_EQ(frame.frame().coverage[1], 0U);
  EXPECT_EQ(frame.frame().normal[5], 0.0F);
  EXPECT_EQ(frame.frame().rgb[0], 100);
}

TEST(FrameAssembly, KeepsLevelsAloneWhereNobodyObserves) {
  FrameAssembly frame = assembly(false);
  frame.add_line(0, levels(7), fragments());
  EXPECT_EQ(frame.frame().rgb[0], 7);
  EXPECT_TRUE(frame.frame().object.empty());
}

}  // namespace
}  // namespace rastertlm::video
