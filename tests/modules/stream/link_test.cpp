// Are a link's figures those of its width and clock?
#include "modules/stream/link.h"

#include <gtest/gtest.h>

namespace rastertlm::stream {
namespace {

// 64 bits at 60 ns: 8 bytes / 60e-9 s = 133.33 MB/s.
TEST(Link, PeakIsOneWordACycle) {
  const Link link("board 0", 64, Clock::from_period_ns("pixel clock", 60.0));
  EXPECT_NEAR(link.peak_bytes_per_second(), 8 / 60e-9, 1e-3);
  EXPECT_EQ(link.name(), "board 0");
  EXPECT_EQ(Link("bits", 12, Clock::from_frequency_hz("c", 1'000'000)).peak_bytes_per_second(), 1.5e6);
}

TEST(Link, CountsWordsCyclesAndWholeBytes) {
  Link link("narrow", 12, Clock::from_frequency_hz("c", 1'000'000));
  link.record(3, Cycles(5));
  EXPECT_EQ(link.words(), 3U);
  EXPECT_EQ(link.active(), Cycles(5));
  EXPECT_EQ(link.bytes(), 4U);  // 36 bits
  link.record(1, Cycles(1));    // 48 bits: the half bytes join
  EXPECT_EQ(link.words(), 4U);
  EXPECT_EQ(link.active(), Cycles(6));
  EXPECT_EQ(link.bytes(), 6U);
}

TEST(Link, StartsAgain) {
  Link link("bus", 32, Clock::from_frequency_hz("c", 1'000'000));
  link.record(10, Cycles(30));
  link.reset(0);
  EXPECT_EQ(link.words(), 0U);
  EXPECT_EQ(link.bytes(), 0U);
  EXPECT_EQ(link.active(), Cycles(0));
}

// What is under way when counting starts or ends is counted as far as it has crossed then, to the last whole word.
TEST(Link, CountsWhatHasCrossed) {
  Link link("link", 8, Clock::from_frequency_hz("bytes", 1'000'000));
  link.record(100, Cycles(100), 1'000'000, 101'000'000);  // a byte a microsecond
  EXPECT_EQ(link.at(1'000'000).words(), 0U);
  EXPECT_EQ(link.at(1'999'999).words(), 0U);
  EXPECT_EQ(link.at(2'000'000).words(), 1U);
  EXPECT_EQ(link.at(51'000'000).words(), 50U);
  EXPECT_EQ(link.at(51'000'000).active(), Cycles(50));
  EXPECT_EQ(link.at(101'000'000).words(), 100U);
  EXPECT_EQ(link.at(900'000'000).words(), 100U);
  link.reset(31'000'000);
  EXPECT_EQ(link.at(31'000'000).words(), 0U);
  EXPECT_EQ(link.at(51'000'000).words(), 20U);
  EXPECT_EQ(link.words(), 70U);
  link.record(10, Cycles(10), 200'000'000, 210'000'000);
  EXPECT_EQ(link.at(205'000'000).words(), 75U);
  link.reset(300'000'000);
  EXPECT_EQ(link.words(), 0U);
}

}  // namespace
}  // namespace rastertlm::stream
