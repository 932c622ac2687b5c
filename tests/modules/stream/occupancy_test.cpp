// Do the four activities of a unit always add up, and does a cycle belong to the activity during which it begins?
#include "modules/stream/occupancy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace rastertlm::stream {
namespace {

struct Transition {
  std::uint64_t picoseconds;
  Activity activity;
};

std::array<std::uint64_t, 4> parts(const Occupancy& occupancy) {
  return {occupancy.busy, occupancy.starved, occupancy.blocked, occupancy.idle};
}

// Cycle by cycle, in integers: cycle n of `megahertz` begins n / megahertz microseconds after the start, to the nearest
// picosecond.
std::array<std::uint64_t, 4> by_cycle(std::uint64_t megahertz, const std::vector<Transition>& transitions,
                                      std::uint64_t begin, std::uint64_t end) {
  std::array<std::uint64_t, 4> count{};
  for (std::uint64_t n = 0;; ++n) {
    const std::uint64_t start = (2 * n * 1'000'000 + megahertz) / (2 * megahertz);
    if (start >= end) break;
    if (start < begin) continue;
    Activity activity = Activity::idle;
    for (const Transition& t : transitions)
      if (t.picoseconds <= start) activity = t.activity;
    ++count[static_cast<std::size_t>(activity)];
  }
  return count;
}

// Frequencies whose periods no number of picoseconds is, 30 MHz among them.
RC_GTEST_PROP(OccupancyMeter, CountsEveryCycleOnce, ()) {
  const auto megahertz = *rc::gen::element<std::uint64_t>(30, 7, 20, 33, 16);
  OccupancyMeter meter(Clock::from_frequency_hz("host", megahertz * 1'000'000));
  const auto times = *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(0, 3'000'000));
  std::vector<Transition> transitions;
  transitions.reserve(times.size());
  for (const std::uint64_t time : times)
    transitions.push_back(
        {time, *rc::gen::element(Activity::busy, Activity::starved, Activity::blocked, Activity::idle)});
  std::stable_sort(transitions.begin(), transitions.end(),
                   [](const Transition& a, const Transition& b) { return a.picoseconds < b.picoseconds; });
  for (const Transition& t : transitions) meter.enter(t.activity, t.picoseconds);
  const std::uint64_t end =
      (transitions.empty() ? 0 : transitions.back().picoseconds) + *rc::gen::inRange<std::uint64_t>(0, 500'000);
  const Occupancy& occupancy = meter.close(end);
  occupancy.check("unit");
  RC_ASSERT(parts(occupancy) == by_cycle(megahertz, transitions, 0, end));
}

TEST(OccupancyMeter, WhatWasBeforeARestartIsGone) {
  OccupancyMeter meter(Clock::from_frequency_hz("host", 30'000'000));
  meter.enter(Activity::busy, 0);
  meter.restart(1'000'000);  // 30 cycles
  const Occupancy& occupancy = meter.close(2'000'000);
  EXPECT_EQ(occupancy.cycles, 30U);
  EXPECT_EQ(occupancy.busy, 30U);  // still busy
}

TEST(OccupancyMeter, MayBeClosedAgainLater) {
  OccupancyMeter meter(Clock::from_frequency_hz("host", 1'000'000));
  meter.enter(Activity::blocked, 2'000'000);
  EXPECT_EQ(meter.close(5'000'000).blocked, 3U);
  EXPECT_EQ(meter.close(7'000'000).blocked, 5U);
  EXPECT_EQ(meter.close(7'000'000).cycles, 7U);
}

// The end of a run is computed from whole frames, and may be a picosecond before what happened at it.
TEST(OccupancyMeter, AnEndAPicosecondEarlyTakesNothingBack) {
  OccupancyMeter meter(Clock::from_frequency_hz("host", 1'000'000));
  meter.enter(Activity::busy, 0);
  meter.enter(Activity::idle, 2'000'001);
  EXPECT_EQ(meter.close(2'000'000).cycles, 3U);
  EXPECT_EQ(meter.close(2'000'000).busy, 3U);
  EXPECT_EQ(meter.close(2'000'000).idle, 0U);
}

TEST(Occupancy, SaysWhatDoesNotAddUp) {
  Occupancy occupancy;
  occupancy.cycles = 10;
  occupancy.busy = 1;
  occupancy.starved = 2;
  occupancy.blocked = 3;
  occupancy.idle = 4;
  EXPECT_NO_THROW(occupancy.check("unit"));
  occupancy.idle = 5;
  try {
    occupancy.check("computation_unit_3");
    FAIL() << "11 of 10 cycles";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("computation_unit_3"),
                                             testing::HasSubstr("busy 1 + starved 2 + blocked 3 + idle 5 is not 10")));
  }
}

}  // namespace
}  // namespace rastertlm::stream
