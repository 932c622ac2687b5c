// Is a frame shown anew only at a retrace at which everything is ready, and does the picture stay until then?
#include "modules/video/video_timing_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include <deque>
#include <stdexcept>

#include "modules/stream/simulated_time.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::video {
namespace {

using stream::SyncPayload;
using testing::ElementsAre;

constexpr std::size_t kLines = 3;
constexpr std::uint64_t kFramePs = 1'000'000'000;  // 1 kHz

// 10,000 clocks of 100 ns: retrace 1,000, lines of 3,000 each.
Timing timing_of_test() {
  VideoParameters parameters;
  parameters.columns = 100;
  parameters.lines = kLines;
  parameters.refresh_hz = 1000;
  parameters.pixel_clock_ns = 100;
  parameters.vertical_retrace_us = 100;
  return timing(parameters);
}

struct Heard {
  int listener;
  bool retrace;
  bool copy;
  bool swap;
  std::uint64_t frame;
  std::size_t line;
  std::uint64_t picoseconds;  // with the annotated delay
};

class Listeners : public sc_core::sc_module {
 public:
  sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<Listeners, stream::kNoBusWidth, stream::SyncProtocol>> sync;
  std::vector<Heard> heard;
  std::size_t calls = 0;

  Listeners(const sc_core::sc_module_name& name, std::size_t count) : sc_module(name), sync("sync", count) {
    for (std::size_t i = 0; i < count; ++i) sync[i].register_b_transport(this, &Listeners::hear, static_cast<int>(i));
  }

 private:
  void hear(int listener, SyncPayload& payload, sc_core::sc_time& delay) {
    EXPECT_FALSE(payload.switch_tables);  // that is the loader's to say
    ++calls;
    for (std::size_t k = 0; k < payload.lines.count; ++k)
      heard.push_back({listener, payload.kind == SyncPayload::Kind::retrace, payload.copy, payload.swap, payload.frame,
                       payload.lines.number(k), stream::picoseconds_now() + delay.value() + payload.lines.later_ps[k]});
    delay += sc_core::sc_time(7, sc_core::SC_MS);  // is nobody else's delay
  }
};

// A machine of two units and two listeners, and a script that says when they are ready.
struct Screen {
  sc_core::sc_signal<bool> unit_0{"unit_0"};
  sc_core::sc_signal<bool> unit_1{"unit_1"};
  sc_core::sc_signal<bool> tables{"tables"};
  VideoTimingModule video;
  Listeners listeners{"listeners", 2};
  std::vector<std::uint64_t> swaps;  // times
  std::deque<stream::Script> scripts;

  Screen(std::uint64_t frames, std::uint64_t patience,
         VideoTimingModule::Copy copy = VideoTimingModule::Copy::when_ready, const Timing& timing = timing_of_test(),
         std::size_t lines = kLines)
      : video("video_timing", timing, lines, 2, 2, frames, patience, copy) {
    video.ready[0].bind(unit_0);
    video.ready[1].bind(unit_1);
    video.tables_ready.bind(tables);
    for (std::size_t i = 0; i < 2; ++i) video.sync[i].bind(listeners.sync[i]);
    scripts.emplace_back("swaps", [this] {
      for (;;) {
        sc_core::wait(video.swapped);
        swaps.push_back(stream::picoseconds_now());
      }
    });
  }

  void set_all(bool value) {
    unit_0.write(value);
    unit_1.write(value);
    tables.write(value);
  }
  // Retraces heard by the first listener: at which frame of the screen, of which displayed frame, whether with a copy.
  std::vector<std::tuple<std::uint64_t, std::uint64_t, bool>> retraces() const {
    std::vector<std::tuple<std::uint64_t, std::uint64_t, bool>> result;
    for (const Heard& one : listeners.heard)
      if (one.retrace && one.listener == 0) result.emplace_back(one.picoseconds / kFramePs, one.frame, one.copy);
    return result;
  }
};

TEST(VideoTimingModule, SaysWhenLinesBeginToEveryListener) {
  Screen screen(2, 10);
  screen.set_all(true);
  stream::simulate();
  ASSERT_EQ(screen.listeners.heard.size(), 2 * 2 * (1 + kLines));
  std::size_t i = 0;
  for (std::uint64_t frame = 0; frame < 2; ++frame)
    for (std::size_t event = 0; event <= kLines; ++event)
      for (int listener = 0; listener < 2; ++listener) {
        const Heard& one = screen.listeners.heard[i++];
        EXPECT_EQ(one.listener, listener);
        EXPECT_EQ(one.frame, frame);
        EXPECT_EQ(one.retrace, event == 0);
        EXPECT_EQ(one.copy, event == 0);
        const std::uint64_t clocks = event == 0 ? 0 : 1000 + 3000 * (event - 1);
        EXPECT_EQ(one.picoseconds, frame * kFramePs + clocks * 100'000);
        if (event > 0) {
          EXPECT_EQ(one.line, event - 1);
        }
      }
  EXPECT_EQ(screen.video.updates(), 2U);
  EXPECT_EQ(screen.video.video_frames_shown(), 2U);
  EXPECT_EQ(sc_core::sc_time_stamp().value(), 2 * kFramePs);
}

// Unit 1 is late for two retraces, then the tables for one: the first picture is that of the fourth retrace.
TEST(VideoTimingModule, ShowsNothingUntilEverythingIsReady) {
  Screen screen(1, 10);
  screen.scripts.emplace_back("script", [&] {
    screen.unit_0.write(true);
    sc_core::wait(stream::to_time(kFramePs + 1));
    screen.unit_1.write(true);
    sc_core::wait(stream::to_time(kFramePs));
    screen.tables.write(true);
  });
  stream::simulate();
  EXPECT_THAT(screen.retraces(), ElementsAre(std::tuple(0, 0, false), std::tuple(1, 0, false), std::tuple(2, 0, false),
                                             std::tuple(3, 0, true)));
  EXPECT_EQ(screen.video.frames_before_first(), 3U);
  EXPECT_EQ(screen.video.first_frame_ps(), 3 * kFramePs);
  EXPECT_EQ(screen.listeners.heard.size(), 2 * (4 + kLines));  // no line before
  EXPECT_THAT(screen.swaps, ElementsAre(3 * kFramePs));
  EXPECT_EQ(screen.video.updates(), 1U);
}

// A late host: the old picture is shown again, its lines are announced as ever.
TEST(VideoTimingModule, KeepsThePictureOfALateHost) {
  Screen screen(5, 10);
  screen.scripts.emplace_back("script", [&] {
    screen.set_all(true);
    sc_core::wait(screen.video.swapped);
    screen.unit_0.write(false);
    sc_core::wait(stream::to_time(2 * kFramePs + 1));
    screen.unit_0.write(true);
    sc_core::wait(screen.video.swapped);
    screen.tables.write(false);
  });
  stream::simulate();
  EXPECT_THAT(screen.retraces(), ElementsAre(std::tuple(0, 0, true), std::tuple(1, 1, false), std::tuple(2, 2, false),
                                             std::tuple(3, 3, true), std::tuple(4, 4, false)));
  EXPECT_THAT(screen.swaps, ElementsAre(0U, 3 * kFramePs));
  EXPECT_EQ(screen.video.updates(), 2U);
  EXPECT_EQ(screen.video.frames_before_first(), 0U);
  EXPECT_EQ(screen.listeners.heard.size(), 5 * 2 * (1 + kLines));
}

TEST(VideoTimingModule, LinesMayBeKeptFromAListener) {
  Screen screen(2, 10);
  screen.video.announce_retraces_alone(0);
  screen.set_all(true);
  stream::simulate();
  std::size_t lines = 0;
  std::size_t retraces = 0;
  for (const Heard& one : screen.listeners.heard)
    if (one.listener == 0) (one.retrace ? retraces : lines) += 1;
  EXPECT_EQ(lines, 0U);
  EXPECT_EQ(retraces, 2U);
  EXPECT_EQ(screen.listeners.heard.size(), 2U * (1 + kLines) + 2);
}

// What a listener hears of lines that are announced in bands is what it hears of lines announced one by one.
std::vector<std::tuple<std::uint64_t, std::size_t, std::uint64_t>> heard_by_first(const Screen& screen) {
  std::vector<std::tuple<std::uint64_t, std::size_t, std::uint64_t>> result;
  for (const Heard& one : screen.listeners.heard)
    if (one.listener == 0 && !one.retrace) result.emplace_back(one.frame, one.line, one.picoseconds);
  return result;
}

// `lines` at 50 clocks each.
void announces_in_bands(bool interlaced, std::size_t calls_a_frame) {
  constexpr std::size_t kManyLines = 100;
  VideoParameters parameters;
  parameters.columns = 20;
  parameters.lines = kManyLines;
  parameters.refresh_hz = 1000;
  parameters.pixel_clock_ns = 99.7;  // no whole number of picoseconds a line
  parameters.vertical_retrace_us = 100;
  parameters.interlaced = interlaced;
  const Timing timing_of_lines = timing(parameters);
  Screen screen(2, 10, VideoTimingModule::Copy::when_ready, timing_of_lines, kManyLines);
  screen.video.announce_lines_in_bands();
  screen.set_all(true);
  stream::simulate();
  std::vector<std::tuple<std::uint64_t, std::size_t, std::uint64_t>> expected;
  for (std::uint64_t field = 0; field < 2 * timing_of_lines.fields; ++field)
    for (std::size_t line = field % timing_of_lines.fields; line < kManyLines; line += timing_of_lines.fields)
      expected.emplace_back(field / timing_of_lines.fields, line,
                            timing_of_lines.clock.picoseconds(timing_of_lines.frame * field) +
                                timing_of_lines.clock.picoseconds(timing_of_lines.line_start(line)));
  EXPECT_EQ(heard_by_first(screen), expected);
  EXPECT_EQ(screen.listeners.calls, 2 * 2 * calls_a_frame);
}

// 13 bands, the last of four lines, and a retrace.
TEST(VideoTimingModule, AnnouncesLinesInBands) { announces_in_bands(false, 14); }

TEST(VideoTimingModule, AnnouncesLinesOfAFieldInBands) { announces_in_bands(true, 2 * 14); }

// Copied at every retrace: once there is a picture, whatever stands in the loading RAMs is shown; the hosts go on, and
// an update is counted, where everything was ready.
TEST(VideoTimingModule, CopiesAtEveryRetraceAfterTheFirstPicture) {
  Screen screen(5, 10, VideoTimingModule::Copy::at_every_retrace);
  screen.scripts.emplace_back("script", [&] {
    sc_core::wait(stream::to_time(kFramePs + 1));
    screen.set_all(true);
    sc_core::wait(screen.video.swapped);
    screen.unit_1.write(false);
    sc_core::wait(stream::to_time(2 * kFramePs + 1));
    screen.unit_1.write(true);
  });
  stream::simulate();
  EXPECT_THAT(screen.retraces(), ElementsAre(std::tuple(0, 0, false), std::tuple(1, 0, false), std::tuple(2, 0, true),
                                             std::tuple(3, 1, true), std::tuple(4, 2, true), std::tuple(5, 3, true),
                                             std::tuple(6, 4, true)));
  std::vector<bool> swapped;
  for (const Heard& one : screen.listeners.heard)
    if (one.retrace && one.listener == 1) swapped.push_back(one.swap);
  EXPECT_THAT(swapped, ElementsAre(false, false, true, false, false, true, true));
  EXPECT_THAT(screen.swaps, ElementsAre(2 * kFramePs, 5 * kFramePs, 6 * kFramePs));
  EXPECT_EQ(screen.video.updates(), 3U);
}

// At the very instant of the retrace is in time, a picosecond later is a frame later.
TEST(VideoTimingModule, ReadyAtTheRetraceIsInTime) {
  Screen screen(1, 10);
  screen.scripts.emplace_back("script", [&] {
    sc_core::wait(stream::to_time(2 * kFramePs));
    screen.set_all(true);
  });
  stream::simulate();
  EXPECT_EQ(screen.video.first_frame_ps(), 2 * kFramePs);
}

TEST(VideoTimingModule, ReadyAPicosecondAfterTheRetraceIsLate) {
  Screen screen(1, 10);
  screen.scripts.emplace_back("script", [&] {
    sc_core::wait(stream::to_time(2 * kFramePs + 1));
    screen.set_all(true);
  });
  stream::simulate();
  EXPECT_EQ(screen.video.first_frame_ps(), 3 * kFramePs);
}

TEST(VideoTimingModule, GivesUpOnHostsThatNeverFinish) {
  Screen screen(1, 4);
  try {
    stream::simulate();
    FAIL() << "waited for ever";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the hosts have not finished a first frame"));
  }
  EXPECT_EQ(sc_core::sc_time_stamp().value(), 5 * kFramePs);
}

// Six lines of which a field has three: its 10,000 clocks are those of the screen above.
Timing interlaced_timing() {
  VideoParameters parameters;
  parameters.columns = 100;
  parameters.lines = 2 * kLines;
  parameters.refresh_hz = 1000;
  parameters.pixel_clock_ns = 100;
  parameters.vertical_retrace_us = 100;
  parameters.interlaced = true;
  return timing(parameters);
}

TEST(VideoTimingModule, ShowsEvenLinesThenOddOnes) {
  Screen screen(2, 10, VideoTimingModule::Copy::when_ready, interlaced_timing(), 2 * kLines);
  screen.set_all(true);
  stream::simulate();
  ASSERT_EQ(screen.listeners.heard.size(), 2 * 2 * 2 * (1 + kLines));
  std::size_t i = 0;
  for (std::uint64_t field = 0; field < 4; ++field)
    for (std::size_t event = 0; event <= kLines; ++event)
      for (int listener = 0; listener < 2; ++listener) {
        const Heard& one = screen.listeners.heard[i++];
        EXPECT_EQ(one.frame, field / 2);
        EXPECT_EQ(one.retrace, event == 0);
        EXPECT_EQ(one.copy, event == 0);  // each field's retrace may copy
        const std::uint64_t clocks = event == 0 ? 0 : 1000 + 3000 * (event - 1);
        EXPECT_EQ(one.picoseconds, field * kFramePs + clocks * 100'000);
        if (event > 0) {
          EXPECT_EQ(one.line, 2 * (event - 1) + field % 2);
        }
      }
  EXPECT_EQ(screen.video.updates(), 4U);
  EXPECT_EQ(screen.video.video_frames_shown(), 4U);
  EXPECT_EQ(sc_core::sc_time_stamp().value(), 4 * kFramePs);
}

// Ready in time for a field of odd lines: the first picture begins with the even ones after it.
TEST(VideoTimingModule, TheFirstPictureBeginsWithEvenLines) {
  Screen screen(1, 10, VideoTimingModule::Copy::when_ready, interlaced_timing(), 2 * kLines);
  screen.scripts.emplace_back("script", [&] {
    sc_core::wait(stream::to_time(kFramePs / 2));
    screen.set_all(true);
  });
  stream::simulate();
  EXPECT_THAT(screen.retraces(), ElementsAre(std::tuple(0, 0, false), std::tuple(1, 0, false), std::tuple(2, 0, true),
                                             std::tuple(3, 0, true)));
  EXPECT_EQ(screen.video.frames_before_first(), 2U);
  EXPECT_THAT(screen.swaps, ElementsAre(2 * kFramePs, 3 * kFramePs));
}

// A late host: its coefficients may come in with the odd lines.
TEST(VideoTimingModule, AnUpdateMayComeInWithTheOddLines) {
  Screen screen(2, 10, VideoTimingModule::Copy::when_ready, interlaced_timing(), 2 * kLines);
  screen.scripts.emplace_back("script", [&] {
    screen.set_all(true);
    sc_core::wait(screen.video.swapped);
    screen.unit_0.write(false);
    sc_core::wait(stream::to_time(2 * kFramePs + 1));
    screen.unit_0.write(true);
  });
  stream::simulate();
  EXPECT_THAT(screen.retraces(), ElementsAre(std::tuple(0, 0, true), std::tuple(1, 0, false), std::tuple(2, 1, false),
                                             std::tuple(3, 1, true)));
}

// A clock whose frame is no whole number of picoseconds: frames are counted from the start, so nothing drifts.
TEST(VideoTimingModule, FramesDoNotDrift) {
  Timing timing = timing_of_test();
  timing.clock = Clock::from_frequency_hz("third", 3'000'000);
  timing.frame = Cycles(7);
  timing.vertical_retrace = Cycles(1);
  timing.line = Cycles(2);
  sc_core::sc_signal<bool> yes{"yes"};
  VideoTimingModule video("video_timing", timing, kLines, 1, 1, 9, 1);
  Listeners listeners("listeners", 1);
  video.ready[0].bind(yes);
  video.tables_ready.bind(yes);
  video.sync[0].bind(listeners.sync[0]);
  yes.write(true);
  stream::simulate();
  std::uint64_t frame = 0;
  for (const Heard& one : listeners.heard)
    if (one.retrace) {
      EXPECT_EQ(one.picoseconds, (14'000'000 * frame + 3) / 6);  // 7/3 us, to nearest
      ++frame;
    }
  EXPECT_EQ(frame, 9U);
}

}  // namespace
}  // namespace rastertlm::video
