// Is the video timing that of the paper, does every frame add up, and is what cannot be shown refused with what would
// do?
#include "modules/video/timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>

#include "src/base/errors.h"

namespace rastertlm::video {
namespace {

VideoParameters screen(std::int64_t columns, std::int64_t lines, double refresh_hz, double pixel_clock_ns,
                       double vertical_retrace_us) {
  VideoParameters parameters;
  parameters.columns = columns;
  parameters.lines = lines;
  parameters.refresh_hz = refresh_hz;
  parameters.pixel_clock_ns = pixel_clock_ns;
  parameters.vertical_retrace_us = vertical_retrace_us;
  return parameters;
}

// The key and the text of the refusal.
std::string refusal(const VideoParameters& parameters) {
  try {
    timing(parameters);
  } catch (const InputError& error) {
    return to_string(error.diagnostics().at(0));
  }
  return "accepted";
}

// 20 ms and 600 us of 60 ns: 333,333 = 512 x 631 + 10,000 + 261; 631 - 512 = 119.
TEST(VideoTiming, ThePapersScreen) {
  const Timing t = timing(VideoParameters{});
  EXPECT_EQ(t.frame, Cycles(333'333));
  EXPECT_EQ(t.line, Cycles(631));
  EXPECT_EQ(t.vertical_retrace, Cycles(10'261));
  EXPECT_EQ(t.horizontal_blanking, Cycles(119));
  EXPECT_EQ(t.line_start(0), Cycles(10'261));
  EXPECT_EQ(t.line_start(511), Cycles(333'333 - 631));
  EXPECT_EQ(t.first_pixel(0), Cycles(10'380));
  EXPECT_DOUBLE_EQ(t.obtained_refresh_hz(), 1.0 / (333'333 * 60e-9));
}

// Against counting clock by clock.
TEST(VideoTiming, SendsPixelsOutsideTheBlanking) {
  const Timing t = timing(screen(7, 3, 10000, 1000, 20));  // 100 clocks: 22 of retrace, three lines of 26
  ASSERT_EQ(t.frame, Cycles(100));
  ASSERT_EQ(t.vertical_retrace, Cycles(22));
  std::uint64_t sent = 0;
  for (std::uint64_t clock = 0; clock < 350; ++clock) {
    EXPECT_EQ(t.pixels_sent(Cycles(clock), 3), sent) << clock;
    const std::uint64_t within = clock % 100;
    if (within >= 22 && (within - 22) % 26 >= 19) ++sent;
  }
}

// 16 MHz: 320,000 = 512 x 606 + 9,600 + 128.
TEST(VideoTiming, SixteenMegahertz) {
  const Timing t = timing(screen(512, 512, 50, 62.5, 600));
  EXPECT_EQ(t.frame, Cycles(320'000));
  EXPECT_EQ(t.line, Cycles(606));
  EXPECT_EQ(t.vertical_retrace, Cycles(9'728));
  EXPECT_EQ(t.horizontal_blanking, Cycles(94));
  EXPECT_DOUBLE_EQ(t.obtained_refresh_hz(), 50.0);
}

// The VGA screen: 800 clocks a line and 525 lines a frame of 25.175 MHz, 45 of them not shown.
TEST(VideoTiming, Vga) {
  const Timing t = timing(screen(640, 480, 25.175e6 / (800 * 525), 1e3 / 25.175, 45 * 800 / 25.175));
  EXPECT_EQ(t.frame, Cycles(800 * 525));
  EXPECT_EQ(t.line, Cycles(800));
  EXPECT_EQ(t.vertical_retrace, Cycles(45 * 800));
  EXPECT_EQ(t.horizontal_blanking, Cycles(160));
}

// 25.2 MHz to the femtosecond: 800 x 525 clocks at 60 Hz.
TEST(VideoTiming, VgaAtSixtyHertz) {
  const Timing t = timing(screen(640, 480, 60, 39.682540, 1428.5714));
  EXPECT_EQ(t.frame, Cycles(800 * 525));
  EXPECT_EQ(t.line, Cycles(800));
  EXPECT_EQ(t.vertical_retrace, Cycles(45 * 800));
  EXPECT_EQ(t.horizontal_blanking, Cycles(160));
  EXPECT_NEAR(t.obtained_refresh_hz(), 60.0, 1e-6);
}

// CEA-861: 74.25 MHz, 1650 clocks a line and 750 lines a frame, 30 of them not shown.
TEST(VideoTiming, HighDefinitionAtSixtyHertz) {
  const Timing t = timing(screen(1280, 720, 60, 13.468013, 666.66667));
  EXPECT_EQ(t.frame, Cycles(1650 * 750));
  EXPECT_EQ(t.line, Cycles(1650));
  EXPECT_EQ(t.vertical_retrace, Cycles(30 * 1650));
  EXPECT_EQ(t.horizontal_blanking, Cycles(370));
  EXPECT_NEAR(t.obtained_refresh_hz(), 60.0, 1e-5);
}

// The paper's screen at 60 Hz. 60 ns: 277,778 = 512 x 523 + 10,000 + 2; 50 ns: 333,333 = 512 x 627 + 12,000 + 309.
TEST(VideoTiming, ThePapersScreenAtSixtyHertz) {
  const Timing slow = timing(screen(512, 512, 60, 60, 600));
  EXPECT_EQ(slow.frame, Cycles(277'778));
  EXPECT_EQ(slow.vertical_retrace, Cycles(10'002));
  EXPECT_EQ(slow.horizontal_blanking, Cycles(11));
  const Timing quick = timing(screen(512, 512, 60, 50, 600));
  EXPECT_EQ(quick.frame, Cycles(333'333));
  EXPECT_EQ(quick.vertical_retrace, Cycles(12'309));
  EXPECT_EQ(quick.horizontal_blanking, Cycles(115));
}

VideoParameters interlaced(VideoParameters parameters) {
  parameters.interlaced = true;
  return parameters;
}

// 20 ms of 29.25 ns: a field of 683,761 = 512 x 1295 + 20,513 + 208 shows every other of 1024 lines.
TEST(VideoTiming, ThePapersInterlacedScreen) {
  const Timing t = timing(interlaced(screen(1024, 1024, 50, 29.25, 600)));
  EXPECT_EQ(t.fields, 2U);
  EXPECT_EQ(t.frame, Cycles(683'761));
  EXPECT_EQ(t.line, Cycles(1295));
  EXPECT_EQ(t.vertical_retrace, Cycles(20'721));
  EXPECT_EQ(t.horizontal_blanking, Cycles(271));
  for (const std::size_t line : {0U, 1U}) EXPECT_EQ(t.line_start(line), Cycles(20'721));
  for (const std::size_t line : {2U, 3U}) EXPECT_EQ(t.line_start(line), Cycles(20'721 + 1295));
  for (const std::size_t line : {1022U, 1023U}) EXPECT_EQ(t.line_start(line), Cycles(683'761 - 1295));
  // The sums of a line go on by as many lines as are passed: from the line before the first one.
  EXPECT_EQ(t.lines_advanced(0), 1U);
  for (const std::size_t line : {1U, 2U, 1023U}) EXPECT_EQ(t.lines_advanced(line), 2U);
}

TEST(VideoTiming, RefusesAnInterlacedScreenOfOddLines) {
  EXPECT_EQ(
      refusal(interlaced(screen(512, 511, 50, 60, 600))),
      "video.lines: is 511; an interlaced picture has as many odd lines as even ones, and an even number of lines");
  EXPECT_EQ(refusal(screen(512, 511, 50, 60, 600)), "accepted");
  EXPECT_EQ(refusal(interlaced(screen(512, 512, 50, 60, 600))), "accepted");
}

TEST(VideoTiming, RefusesARetraceThatIsTheWholeFrame) {
  EXPECT_EQ(refusal(screen(512, 512, 50, 60, 20'000)),
            "video.vertical_retrace_us: a retrace of 20000 us (333333 pixel clocks) is not shorter than the frame of "
            "333333 pixel clocks at 50 Hz");
  EXPECT_THAT(refusal(screen(1, 1, 1000, 60, 2'000)), testing::StartsWith("video.vertical_retrace_us: "));
}

// 19.4 ms hold 242,500 clocks of 80 ns, 473 for each of 512 lines.
TEST(VideoTiming, RefusesALineWithoutBlanking) {
  EXPECT_THAT(refusal(screen(512, 512, 50, 80, 600)),
              testing::StartsWith("video.pixel_clock_ns: a pixel clock of 80 ns leaves 473 clocks for a line of 512 "
                                  "pixels, and no horizontal blanking; at most 73.86 ns would leave some"));
  // As many clocks as pixels leave no blanking; one more does.
  EXPECT_THAT(refusal(screen(606, 512, 50, 62.5, 600)), testing::HasSubstr("leaves 606 clocks for a line of 606"));
  EXPECT_EQ(timing(screen(605, 512, 50, 62.5, 600)).horizontal_blanking, Cycles(1));
}

// 10 ns are shown of a frame: no clock that the machine may have would do, so none is proposed.
TEST(VideoTiming, ProposesNoClockWhereNoneWouldDo) {
  EXPECT_EQ(refusal(screen(512, 512, 50, 5, 19'999.99)),
            "video.pixel_clock_ns: a pixel clock of 5 ns leaves 0 clocks for a line of 512 pixels, and no horizontal "
            "blanking");
}

// The slowest screen and the fastest clock of the declared ranges still count in whole clocks.
TEST(VideoTiming, TheEndsOfTheRangesAreCountedExactly) {
  const Timing t = timing(screen(1, 1, kSlowestRefreshHz, kFastestClockNs, 0));
  EXPECT_EQ(t.frame, Cycles(1'000'000'000'000));
  EXPECT_EQ(t.line, t.frame);
  EXPECT_EQ(t.clock.picoseconds(t.frame), 100'000'000'000'000U);
}

// The clock that a refusal proposes is accepted, and is not much faster than it must be.
RC_GTEST_PROP(VideoTiming, ProposesAClockThatWouldDo, ()) {
  const auto columns = *rc::gen::inRange<std::int64_t>(1, 2000);
  const auto lines = *rc::gen::inRange<std::int64_t>(1, 2000);
  const double refresh = *rc::gen::inRange(20, 100);
  const double retrace = *rc::gen::inRange(0, 5000);
  const double shown_ns = 1e9 / refresh - 1e3 * retrace;
  const double slow = shown_ns / static_cast<double>(lines * columns) * (1.0 + *rc::gen::inRange(1, 1000) / 1000.0);
  VideoParameters parameters = screen(columns, lines, refresh, slow, retrace);
  parameters.interlaced = *rc::gen::arbitrary<bool>();
  if (parameters.interlaced) parameters.lines *= 2;  // as many in a field
  const std::string text = refusal(parameters);
  const std::string before = "at most ";
  const std::size_t at = text.find(before);
  RC_ASSERT(at != std::string::npos);
  const double proposed = std::stod(text.substr(at + before.size()));
  parameters.pixel_clock_ns = proposed;
  RC_ASSERT(timing(parameters).horizontal_blanking >= Cycles(1));
  const double clocks = static_cast<double>(lines * (columns + 1));
  RC_ASSERT((proposed + 0.001) * (clocks + 2) > shown_ns);
}

RC_GTEST_PROP(VideoTiming, EveryFrameAddsUp, ()) {
  const auto columns = *rc::gen::inRange<std::int64_t>(1, 3000);
  const auto lines = *rc::gen::inRange<std::int64_t>(1, 3000);
  const double refresh = *rc::gen::inRange(100, 20'000) / 100.0;
  const double period = *rc::gen::inRange(100, 100'000) / 1000.0;
  const double retrace = *rc::gen::inRange(0, 100'000) / 100.0;
  VideoParameters parameters = screen(columns, lines, refresh, period, retrace);
  parameters.interlaced = *rc::gen::arbitrary<bool>();
  if (parameters.interlaced) parameters.lines *= 2;  // as many in a field
  Timing t;
  try {
    t = timing(parameters);
  } catch (const InputError&) {
    RC_DISCARD("refused");
  }
  const auto count = static_cast<std::uint64_t>(lines);
  RC_ASSERT(t.vertical_retrace + t.line * count == t.frame);
  RC_ASSERT(t.horizontal_blanking + Cycles(static_cast<std::uint64_t>(columns)) == t.line);
  RC_ASSERT(t.horizontal_blanking >= Cycles(1));
  // Whole numbers in long double: nearest to what was asked.
  const long double clocks = 1e9L / (static_cast<long double>(refresh) * static_cast<long double>(period));
  RC_ASSERT(std::abs(static_cast<long double>(t.frame.count()) - clocks) <= 0.5L + 1e-6L);
  const long double asked = 1e3L * static_cast<long double>(retrace) / static_cast<long double>(period);
  const long double left_over = static_cast<long double>(t.vertical_retrace.count()) - asked;
  RC_ASSERT(left_over > -0.5L - 1e-6L);
  RC_ASSERT(left_over < static_cast<long double>(lines) + 0.5L);
  RC_ASSERT(t.line_start(count * t.fields) == t.frame);
}

}  // namespace
}  // namespace rastertlm::video
