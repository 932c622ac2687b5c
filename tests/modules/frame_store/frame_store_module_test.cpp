// When is a span taken, when may a frame be drawn, when is it shown, and what do its lines show?
#include "modules/frame_store/frame_store_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "modules/stream/simulated_time.h"
#include "tests/modules/frame_store/small_screen.h"
#include "tests/modules/stream/simulation.h"

namespace rastertlm::frame_store {
namespace {

constexpr std::uint32_t kColumns = 20;
constexpr std::uint32_t kLines = 6;
constexpr std::uint64_t kClock = 100'000;  // of the screen, in picoseconds
constexpr std::uint64_t kVideoFrame = 500 * kClock;
constexpr std::uint64_t kFirstLine = 50 * kClock;
constexpr std::uint64_t kLine = 75 * kClock;
constexpr std::uint64_t kBlanking = 55 * kClock;
constexpr std::uint64_t kAccess = 30'000;
constexpr std::uint64_t kBurst = kColumns * kAccess;  // a pixel a word

FrameStoreParameters memory_of_30_ns() {
  FrameStoreParameters parameters;
  parameters.access_ns = 30.0;
  return parameters;
}

// A frame store with a span unit that asks when the test says, and a screen.
struct Machine : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Machine, stream::kNoBusWidth, SpanProtocol> spans;
  tlm_utils::simple_target_socket<Machine, stream::kNoBusWidth, stream::RgbProtocol> screen;
  struct Line {
    std::uint64_t frame;
    std::size_t line;
    std::uint64_t picoseconds;
    std::vector<std::uint8_t> levels;
  };
  std::vector<Line> lines;
  FrameStoreParameters parameters;
  video::Timing timing = small_screen();
  FrameStore store;
  FrameStoreModule module;

  Machine(const sc_core::sc_module_name& name, const FrameStoreParameters& given, std::uint64_t pixel_ps = 0)
      : sc_module(name),
        spans("spans"),
        screen("screen"),
        parameters(given),
        store(parameters, {.columns = kColumns, .lines = kLines, .background = {7, 7, 7}}),
        module("frame_store", parameters, store, MemoryLayout::of(parameters, kColumns, kLines, 24, false), timing,
               pixel_ps) {
    screen.register_b_transport(this, &Machine::receive);
    spans.bind(module.in);
    module.out.bind(screen);
  }

  // Picoseconds at which the frame may be drawn, asked for at `at`.
  std::uint64_t begin(std::uint64_t frame, std::uint64_t at) {
    return transport({}, SpanPayload::Kind::frame, frame, at);
  }
  // At which the memory has taken `count` pixels of one level and depth.
  std::uint64_t draw(std::uint32_t line, std::uint32_t column, std::uint32_t count, std::uint32_t depth,
                     std::uint8_t red, std::uint64_t at) {
    span_unit::Span span;
    span.line = line;
    span.column = column;
    span.count = count;
    span.cycles = count;
    span.i[0] = std::uint64_t{red} << 20;
    span.i[span_unit::kDepthSet] = std::uint64_t{depth} << 8;
    return transport(span, SpanPayload::Kind::spans, 0, at);
  }
  // At which the frame is shown.
  std::uint64_t end(std::uint64_t frame, std::uint64_t at) {
    transport({}, SpanPayload::Kind::end, frame, at);
    return payload_.shown_ps;
  }

 private:
  std::uint64_t transport(const span_unit::Span& span, SpanPayload::Kind kind, std::uint64_t frame, std::uint64_t at) {
    payload_.kind = kind;
    payload_.frame = frame;
    payload_.spans = {&span, 1};
    payload_.pixels = span.count;
    payload_.object = 1;
    const std::uint64_t now = stream::picoseconds_now();
    sc_core::sc_time delay = stream::to_time(at - now);
    spans->b_transport(payload_, delay);
    EXPECT_TRUE(payload_.is_response_ok());
    return now + delay.value();
  }
  void receive(stream::RgbPayload& payload, sc_core::sc_time& delay) {
    lines.push_back({payload.frame, payload.line, stream::picoseconds_now() + delay.value(), payload.rgb->levels});
  }
  SpanPayload payload_;
};

void simulated(const std::function<void()>& body) {
  stream::Script script("script", body);
  stream::simulate();
}

// A word read and a word written for each pixel; those that are hidden are read.
TEST(FrameStoreModule, TakesASpanInItsAccesses) {
  Machine m("m", memory_of_30_ns());
  simulated([&] {
    EXPECT_EQ(m.draw(2, 3, 4, 100, 1, 1'000), 1'000 + 8 * kAccess);
    EXPECT_EQ(m.draw(2, 2, 4, 200, 2, 1'000), 1'000 + (8 + 4 + 1) * kAccess);  // after the first; one is seen
    EXPECT_EQ(m.draw(2, 0, 2, 100, 3, 9'000'000), 9'000'000 + 4 * kAccess);
  });
  EXPECT_EQ(m.module.drawing_accesses(), 8U + 5 + 4);
}

// Pixels of both ends win, of three words the two that hold them are written, by banks that work side by side.
TEST(FrameStoreModule, WritesTheWordsThatHoldWhatWon) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.width_bits = 96;  // two pixels
  Machine one("one", parameters);
  parameters.banks = 2;
  Machine two("two", parameters);
  simulated([&] {
    for (Machine* m : {&one, &two}) m->draw(0, 1, 4, 50, 1, 0);
    EXPECT_EQ(one.draw(0, 0, 6, 80, 2, kClock * 10), kClock * 10 + (3 + 2) * kAccess);
    EXPECT_EQ(two.draw(0, 0, 6, 80, 2, kClock * 10), kClock * 10 + (2 + 2) * kAccess);  // words 0 and 2 share a bank
  });
}

TEST(FrameStoreModule, ClearsBeforeAFrameIsDrawn) {
  FrameStoreParameters parameters = memory_of_30_ns();
  Machine clears("clears", parameters);
  parameters.clear = false;
  Machine keeps("keeps", parameters);
  simulated([&] {
    EXPECT_EQ(clears.begin(0, 5'000), 5'000 + kColumns * kLines * kAccess);
    EXPECT_EQ(keeps.begin(0, 5'000), 5'000U);
    for (Machine* m : {&clears, &keeps}) {
      m->draw(4, 0, 1, 100, 30, 100 * kClock);
      m->end(0, 101 * kClock);  // the other buffer
      m->end(1, m->begin(1, 101 * kClock) + kClock);
      m->begin(2, 3 * kVideoFrame);
      m->draw(4, 0, 2, 200, 60, 3 * kVideoFrame + 100 * kClock);  // farther than what was there
      m->end(2, 3 * kVideoFrame + 101 * kClock);
    }
  });
  EXPECT_EQ(clears.module.clear_accesses(), 3U * kColumns * kLines);
  EXPECT_EQ(keeps.module.clear_accesses(), 0U);
  EXPECT_EQ(clears.lines[2 * kLines + 4].levels[0], 60);
  EXPECT_EQ(keeps.lines[2 * kLines + 4].levels[0], 30);  // what was there before
  EXPECT_EQ(keeps.lines[2 * kLines + 4].levels[3], 60);
}

// What ends at the very instant of a retrace is in time. The buffer that was shown until then is free.
TEST(FrameStoreModule, ShowsAtTheRetrace) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.clear = false;
  Machine m("m", parameters);
  simulated([&] {
    EXPECT_EQ(m.begin(0, 0), 0U);
    EXPECT_EQ(m.end(0, kVideoFrame), kVideoFrame);
    EXPECT_EQ(m.begin(1, kVideoFrame), kVideoFrame);
    EXPECT_EQ(m.end(1, kVideoFrame + 1), 2 * kVideoFrame);
    EXPECT_EQ(m.begin(2, kVideoFrame + 2), 2 * kVideoFrame);
    EXPECT_EQ(m.begin(2, 2 * kVideoFrame + 3), 2 * kVideoFrame + 3);
  });
}

// One buffer is drawn again when a screen has shown it, from one retrace to the next.
TEST(FrameStoreModule, OneBufferIsShownOnceBeforeItIsDrawnAgain) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.clear = false;
  parameters.buffers = 1;
  Machine m("m", parameters);
  simulated([&] {
    EXPECT_EQ(m.begin(0, 0), 0U);
    EXPECT_EQ(m.end(0, kClock), kVideoFrame);
    EXPECT_EQ(m.begin(1, 2 * kClock), 2 * kVideoFrame);
    EXPECT_EQ(m.end(1, 2 * kVideoFrame), 2 * kVideoFrame);
    EXPECT_EQ(m.begin(2, 2 * kVideoFrame), 3 * kVideoFrame);
  });
}

TEST(FrameStoreModule, OrAsSoonAsItIsWhole) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.clear = false;
  parameters.swap = Swap::completion;
  Machine two("two", parameters);
  parameters.buffers = 1;
  Machine one("one", parameters);
  simulated([&] {
    for (Machine* m : {&two, &one}) {
      EXPECT_EQ(m->end(0, 777'000), 777'000U);
      EXPECT_EQ(m->begin(1, 700'000), 777'000U);
    }
  });
}

TEST(FrameStoreModule, SendsTheLinesOfTheFrameThatIsShown) {
  Machine m("m", memory_of_30_ns());
  simulated([&] {
    const std::uint64_t may = m.begin(0, 0);
    m.draw(5, 19, 1, 9, 200, may);
    m.end(8, kVideoFrame - 3);
  });
  ASSERT_EQ(m.lines.size(), kLines);
  for (std::size_t line = 0; line < kLines; ++line) {
    EXPECT_EQ(m.lines[line].frame, 8U);
    EXPECT_EQ(m.lines[line].line, line);
    EXPECT_EQ(m.lines[line].picoseconds, kVideoFrame + kFirstLine + line * kLine + kBlanking);
    for (std::size_t i = 0; i < 3U * kColumns; ++i) {
      const bool drawn = line == 5 && i >= 57;  // red alone, the last column's
      EXPECT_EQ(m.lines[line].levels[i], drawn ? (i == 57 ? 200 : 0) : 7) << "line " << line << ", level " << i;
    }
  }
}

// A line of the screen goes first from the instant at which it begins; an access that began before ends first.
TEST(FrameStoreModule, LinesOfTheScreenGoFirstAtASharedPort) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.scan_out = ScanOut::shared;
  Machine before("before", parameters);
  Machine at("at", parameters);
  Machine through("through", parameters);
  simulated([&] {
    EXPECT_EQ(before.draw(0, 0, 4, 9, 1, kFirstLine - 8 * kAccess), kFirstLine);
    EXPECT_EQ(at.draw(0, 0, 4, 9, 1, kFirstLine), kFirstLine + kBurst + 8 * kAccess);
    EXPECT_EQ(through.draw(0, 0, 4, 9, 1, kFirstLine - 1), kFirstLine - 1 + kBurst + 8 * kAccess);
    // The next line's, and none of the vertical retrace.
    EXPECT_EQ(at.draw(1, 0, 4, 9, 1, kFirstLine + kLine + kBurst), kFirstLine + kLine + kBurst + 8 * kAccess);
    EXPECT_EQ(at.draw(2, 0, 4, 9, 1, kVideoFrame), kVideoFrame + 8 * kAccess);
  });
  EXPECT_EQ(at.module.scan_out_accesses(kFirstLine), 0U);
  EXPECT_EQ(at.module.scan_out_accesses(kFirstLine + 1), kColumns);
  EXPECT_EQ(at.module.scan_out_accesses(kVideoFrame), kColumns * kLines);
}

// What a viewer sees of one buffer that is drawn while it is shown, pixel by pixel from the writes in the order of
// time: a line is what the writes before the start of its blanking have left.
class Torn : public testing::TestWithParam<std::pair<std::int64_t, bool>> {};  // buffers, clear

TEST_P(Torn, ScreensShowWhatWasThereWhenTheyWereRead) {
  FrameStoreParameters parameters = memory_of_30_ns();
  parameters.swap = Swap::completion;
  parameters.depth_test = false;
  parameters.access_ns = 300.0;
  std::tie(parameters.buffers, parameters.clear) = GetParam();
  Machine m("m", parameters, kClock);
  struct Write {
    std::uint64_t picoseconds;
    std::size_t buffer;
    std::size_t line, begin, end;
    std::uint8_t level;
  };
  std::vector<Write> writes;
  std::vector<std::uint64_t> drawn;
  constexpr std::uint64_t kFrames = 6;
  simulated([&] {
    std::mt19937 random(11);
    std::uint64_t now = 0;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
      const std::size_t buffer = frame % static_cast<std::size_t>(parameters.buffers);
      const std::uint64_t asked = now;
      now = m.begin(frame, now);
      if (parameters.clear)
        for (std::size_t line = 0; line < kLines; ++line)
          writes.push_back({asked + (now - asked) * line / kLines, buffer, line, 0, kColumns, 7});
      for (int i = 0; i < 40; ++i) {
        const auto line = static_cast<std::uint32_t>(random() % kLines);
        const auto column = static_cast<std::uint32_t>(random() % (kColumns - 4));
        const auto level = static_cast<std::uint8_t>(20 + random() % 200);
        writes.push_back({now, buffer, line, column, column + 4U, level});
        now = m.draw(line, column, 4, 9, level, now) + random() % 900'000;
      }
      now = m.end(frame, now);
      drawn.push_back(now);
    }
    m.module.finish();
  });
  ASSERT_EQ(m.lines.size(), kFrames * kLines);
  std::size_t torn_frames = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const std::uint64_t screen = (drawn[frame] + kVideoFrame - 1) / kVideoFrame * kVideoFrame;
    // Level of a pixel's red at a time, in the buffer that is shown then.
    const auto seen = [&](std::size_t line, std::size_t column, std::uint64_t at) {
      std::size_t latest = frame;
      while (latest + 1 < kFrames && drawn[latest + 1] < at) ++latest;
      const std::size_t buffer = latest % static_cast<std::size_t>(parameters.buffers);
      int level = 7;
      for (const Write& write : writes)
        if (write.picoseconds < at && write.buffer == buffer && write.line == line && column >= write.begin &&
            column < write.end)
          level = write.level;
      return level;
    };
    std::uint64_t torn = 0;
    for (std::size_t line = 0; line < kLines; ++line) {
      const auto found = std::find_if(m.lines.begin(), m.lines.end(),
                                      [&](const auto& l) { return l.frame == frame && l.line == line; });
      ASSERT_NE(found, m.lines.end());
      const std::uint64_t read = screen + kFirstLine + line * kLine;
      EXPECT_GE(found->picoseconds, read + kBlanking);
      bool as_it_was = true;
      for (std::size_t column = 0; column < kColumns; ++column) {
        EXPECT_EQ(found->levels[3 * column], seen(line, column, read)) << frame << ", " << line << ", " << column;
        as_it_was = as_it_was && found->levels[3 * column] == seen(line, column, drawn[frame]);
      }
      torn += as_it_was ? 0 : 1;
    }
    EXPECT_EQ(m.module.torn_lines(frame), torn) << frame;
    torn_frames += torn > 0 ? 1 : 0;
  }
  EXPECT_GT(torn_frames, 1U);
}

INSTANTIATE_TEST_SUITE_P(Buffers, Torn,
                         testing::Values(std::pair(1, true), std::pair(1, false), std::pair(2, true),
                                         std::pair(2, false)));

// Busy with its accesses, starved while a frame is drawn and nobody asks, idle between frames.
TEST(FrameStoreModule, TellsWhereItsTimeWent) {
  constexpr std::uint64_t kClear = kColumns * kLines;
  FrameStoreParameters parameters = memory_of_30_ns();
  Machine own("own", parameters);
  parameters.scan_out = ScanOut::shared;
  Machine shared("shared", parameters);
  simulated([&] {
    for (Machine* m : {&own, &shared}) {
      const std::uint64_t may = m->begin(0, 10 * kAccess);
      ASSERT_EQ(may, (10 + kClear) * kAccess);    // before the first line of the screen
      m->draw(0, 0, 4, 9, 1, may + 5 * kAccess);  // eight accesses
      EXPECT_EQ(m->end(0, may + 20 * kAccess), kVideoFrame);
    }
  });
  const std::uint64_t end = 2 * kVideoFrame;
  const stream::Occupancy alone = own.module.occupancy(end);
  EXPECT_EQ(alone.cycles, end / kAccess);
  EXPECT_EQ(alone.busy, kClear + 8);
  EXPECT_EQ(alone.starved, 20U - 8);
  EXPECT_EQ(alone.idle, end / kAccess - kClear - 20);
  const stream::Occupancy with_screen = shared.module.occupancy(end);
  EXPECT_EQ(with_screen.busy, kClear + 8 + 2 * kColumns * kLines);  // two screens were read
  EXPECT_EQ(with_screen.starved, 20U - 8);
  EXPECT_EQ(with_screen.idle, end / kAccess - kClear - 20 - 2 * kColumns * kLines);
}

// A memory that a span unit need never wait for is not asked, and counts the same; asked, it would keep up. Where a
// pixel takes a picosecond less it is asked.
class KeepsUp : public testing::TestWithParam<std::pair<std::int64_t, std::int64_t>> {};  // bits, banks

TEST_P(KeepsUp, AndIsNotAskedThen) {
  constexpr std::uint64_t kPixel = 60'000;
  FrameStoreParameters parameters = memory_of_30_ns();
  std::tie(parameters.width_bits, parameters.banks) = GetParam();
  Machine quick("quick", parameters, kPixel);
  Machine asked("asked", parameters);
  Machine slow("slow", parameters, kPixel - 1);
  EXPECT_TRUE(quick.module.never_waited_for());
  EXPECT_FALSE(asked.module.never_waited_for());
  EXPECT_FALSE(slow.module.never_waited_for());
  simulated([&] {
    std::mt19937 random(3);
    std::uint64_t now = 0;
    for (int span = 0; span < 400; ++span) {
      const auto column = static_cast<std::uint32_t>(random() % kColumns);
      const auto count = static_cast<std::uint32_t>(1 + random() % (kColumns - column));
      const auto line = static_cast<std::uint32_t>(random() % kLines);
      const auto depth = static_cast<std::uint32_t>(random() % 1000);
      EXPECT_EQ(quick.draw(line, column, count, depth, 1, now), now);
      EXPECT_LE(asked.draw(line, column, count, depth, 1, now), now + count * kPixel);
      now += count * kPixel;
    }
  });
  EXPECT_EQ(quick.module.drawing_accesses(), asked.module.drawing_accesses());
  EXPECT_GT(quick.module.drawing_accesses(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Widths, KeepsUp, testing::Values(std::pair(64, 1), std::pair(96, 1), std::pair(128, 3)));

}  // namespace
}  // namespace rastertlm::frame_store
