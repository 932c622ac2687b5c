// Does a run of words end when it would if every host cycle were looked at one by one?
#include "modules/host/bus_schedule.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace rastertlm::host {
namespace {

struct Outcome {
  std::vector<std::uint64_t> visible;  // words that stand in the loading RAM at each retrace
  std::uint64_t end = 0;               // cycle
  std::uint64_t blocked = 0;
};

struct Copies {
  CopyTimes times;
  std::uint64_t retrace;  // that started the update
  std::uint64_t start_ps() const { return times.clock.picoseconds(times.period * retrace); }
  std::uint64_t begin(std::size_t i) const {
    return times.clock.picoseconds(times.period * (retrace + i)) - start_ps();
  }
  std::uint64_t end(std::size_t i) const {
    return times.clock.picoseconds(times.period * (retrace + i) + times.duration) - start_ps();
  }
};

// Cycle after cycle: arithmetic goes on, a word's cycle that starts within a copy stands still; a word stands when its
// last cycle has ended.
Outcome cycle_by_cycle(const Clock& host, const Copies& copies, const std::vector<Segment>& segments,
                       std::uint64_t word, std::uint64_t start, std::size_t retraces) {
  Outcome outcome;
  outcome.visible.assign(retraces, 0);
  std::uint64_t cycle = start;
  std::uint64_t written = 0;
  for (const Segment& segment : segments) {
    cycle += segment.compute.count();
    for (std::uint64_t moved = 0; moved < segment.words * word; ++cycle) {
      const std::uint64_t at = host.picoseconds(Cycles(cycle));
      bool stalled = false;
      for (std::size_t i = 0; i < (copies.times.every_retrace ? retraces : 1); ++i)
        stalled = stalled || (copies.begin(i) <= at && at < copies.end(i));
      if (stalled) {
        ++outcome.blocked;
        continue;
      }
      if (++moved % word != 0) continue;
      ++written;
      for (std::size_t i = 0; i < retraces; ++i)
        if (host.picoseconds(Cycles(cycle + 1)) <= copies.begin(i)) outcome.visible[i] = written;
    }
  }
  outcome.end = cycle;
  return outcome;
}

RC_GTEST_PROP(BusBurst, IsWhatSteppingEveryCycleGives, ()) {
  const Clock host = Clock::from_frequency_hz(
      "host", *rc::gen::element<std::uint64_t>(20'000'000, 30'000'000, 7'000'000, 150'000'000));
  Copies copies;
  copies.times.clock = Clock::from_period_ns("pixel", *rc::gen::element(60.0, 62.5, 13.468));
  copies.times.duration = Cycles(*rc::gen::inRange<std::uint64_t>(0, 40));
  copies.times.period = Cycles(*rc::gen::inRange<std::uint64_t>(100, 400));
  copies.times.every_retrace = *rc::gen::arbitrary<bool>();
  copies.retrace = *rc::gen::inRange<std::uint64_t>(0, 50);
  const auto word = *rc::gen::inRange<std::uint64_t>(1, 7);
  const auto start = *rc::gen::inRange<std::uint64_t>(0, 300);
  std::vector<Segment> segments(*rc::gen::inRange<std::size_t>(1, 12));
  std::uint64_t words = 0;
  std::uint64_t cycles = 0;
  for (Segment& segment : segments) {
    segment.compute = Cycles(*rc::gen::inRange<std::uint64_t>(0, 90));
    segment.words = *rc::gen::inRange<std::uint64_t>(0, 23);
    words += segment.words;
    cycles += segment.compute.count() + word * segment.words;
  }
  constexpr std::size_t kRetraces = 400;
  const Outcome expected = cycle_by_cycle(host, copies, segments, word, start, kRetraces);

  const BusSchedule schedule(host, copies.times, copies.start_ps());
  BusBurst burst(schedule, segments, Cycles(word), Cycles(start));
  std::uint64_t busy = 0;
  std::uint64_t blocked = 0;
  std::uint64_t written = 0;
  std::size_t copied = 0;  // retraces that the burst has passed
  while (!burst.done()) {
    const std::uint64_t before_ps = host.picoseconds(burst.cycle());
    const BusBurst::Step step = burst.step();
    // Words of a step are written at its start: copies up to there have seen those before, and none of its own.
    if (copies.times.every_retrace && step.words > 0)
      for (; copies.begin(copied) <= before_ps; ++copied) RC_ASSERT(expected.visible[copied] == written);
    written += step.words;
    busy += step.busy.count();
    blocked += step.blocked.count();
  }
  RC_ASSERT(written == words);
  RC_ASSERT(busy == cycles);
  RC_ASSERT(blocked == expected.blocked);
  RC_ASSERT(burst.cycle().count() == expected.end);
}

// 20 MHz and 60 ns: a copy of 8 pixel clocks, 480 ns, stops the ten cycles that start within it.
TEST(BusBurst, StandsStillWhileTheBoardsCopy) {
  const Clock host = Clock::from_frequency_hz("host", 20'000'000);
  const CopyTimes copies{Clock::from_period_ns("pixel", 60.0), Cycles(333'333), Cycles(8), true};
  const BusSchedule schedule(host, copies, 0);
  // The second retrace begins at 19,999,980 ns, within cycle 399,999: 399,999 cycles have ended.
  const auto second = schedule.next(Cycles(10));
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->visible, Cycles(399'999));
  EXPECT_EQ(second->begin, Cycles(400'000));
  EXPECT_EQ(second->end, Cycles(400'010));
  // Words of three cycles from 399,990 on: three end before the copy; the fourth has had one cycle, goes on after it.
  const std::vector<Segment> words{{Cycles(0), 5}};
  BusBurst burst(schedule, words, Cycles(3), Cycles(399'990));
  const BusBurst::Step before = burst.step();
  EXPECT_EQ(before.words, 3U);
  EXPECT_EQ(before.busy, Cycles(10));
  const BusBurst::Step copy = burst.step();
  EXPECT_EQ(copy.words, 0U);
  EXPECT_EQ(copy.blocked, Cycles(10));
  const BusBurst::Step after = burst.step();
  EXPECT_EQ(after.words, 2U);
  EXPECT_EQ(after.busy, Cycles(5));
  EXPECT_EQ(burst.cycle(), Cycles(400'015));
  EXPECT_TRUE(burst.done());
}

// Arithmetic goes on during a copy: only what is left of the copy when it ends stops the words behind it.
TEST(BusBurst, ArithmeticGoesOnDuringACopy) {
  const Clock host = Clock::from_frequency_hz("host", 20'000'000);
  const CopyTimes copies{Clock::from_period_ns("pixel", 60.0), Cycles(333'333), Cycles(8), true};
  const BusSchedule schedule(host, copies, 0);
  const std::vector<Segment> segments{{Cycles(16), 1}};
  BusBurst burst(schedule, segments, Cycles(3), Cycles(399'990));
  EXPECT_EQ(burst.step().busy, Cycles(16));
  EXPECT_EQ(burst.step().blocked, Cycles(4));
  const BusBurst::Step last = burst.step();
  EXPECT_EQ(last.words, 1U);
  EXPECT_EQ(last.busy, Cycles(3));
  EXPECT_EQ(burst.cycle(), Cycles(400'013));
}

TEST(BusBurst, NothingStopsTheInitialLoad) {
  const BusSchedule schedule(Clock::from_frequency_hz("host", 20'000'000));
  const std::vector<Segment> words{{Cycles(0), 1'000'000}};
  BusBurst burst(schedule, words, Cycles(3), Cycles(7));
  EXPECT_EQ(burst.step().words, 1'000'000U);
  EXPECT_EQ(burst.cycle(), Cycles(3'000'007));
  EXPECT_TRUE(burst.done());
}

}  // namespace
}  // namespace rastertlm::host
