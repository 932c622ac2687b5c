// Does the memory serve in the order of the rules, and is a screen refused that would take all of it?
#include "modules/frame_store/memory_schedule.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/modules/frame_store/small_screen.h"

namespace rastertlm::frame_store {
namespace {

// Access by access: a burst that is due goes first.
class ByAccess {
 public:
  ByAccess(std::uint64_t access, const video::Timing& timing, std::uint64_t lines, std::uint64_t burst)
      : access_(access), timing_(timing), lines_(lines), burst_(burst) {}
  std::uint64_t serve(std::uint64_t begin, std::uint64_t accesses) {
    std::uint64_t now = std::max(begin, free_);
    for (std::uint64_t i = 0; i < accesses; ++i) {
      while (due() <= now) {
        const std::uint64_t starts = std::max(due(), free_);
        free_ = starts + burst_ * access_;
        now = std::max(now, free_);
        ++next_;
      }
      now += access_;
      free_ = now;
    }
    return now;
  }

 private:
  std::uint64_t due() const {
    return timing_.clock.picoseconds(timing_.frame * (next_ / lines_) + timing_.line_start(next_ % lines_));
  }
  std::uint64_t access_;
  video::Timing timing_;
  std::uint64_t lines_;
  std::uint64_t burst_;
  std::uint64_t next_ = 0;
  std::uint64_t free_ = 0;
};

TEST(MemorySchedule, ServesAsAnAccessAtATimeWould) {
  std::mt19937_64 random(2);
  std::uint64_t waited = 0;
  for (int round = 0; round < 50; ++round) {
    const std::uint64_t access = 10'000 + random() % 60'000;
    const std::uint64_t burst = 1 + random() % 30;
    MemorySchedule schedule(access, small_screen(), 6, burst);
    ByAccess by_access(access, small_screen(), 6, burst);
    std::uint64_t begin = 0;
    for (int request = 0; request < 200; ++request) {
      begin += random() % 3'000'000;
      const std::uint64_t accesses = random() % 60;
      if (accesses == 0) continue;
      const std::uint64_t end = schedule.serve(begin, accesses);
      ASSERT_EQ(end, by_access.serve(begin, accesses)) << "round " << round << ", request " << request;
      begin = end - std::min<std::uint64_t>(end, random() % 100'000);
    }
    waited += schedule.waited_ps();
  }
  EXPECT_GT(waited, 0U);
}

TEST(MemorySchedule, APortOfItsOwnWaitsForNobody) {
  MemorySchedule schedule(25'000, std::nullopt, 6, 30);
  EXPECT_EQ(schedule.serve(1'000, 4), 101'000U);
  EXPECT_EQ(schedule.serve(50'000, 2), 151'000U);  // after the first
  EXPECT_EQ(schedule.serve(900'000, 1), 925'000U);
  EXPECT_EQ(schedule.waited_ps(), 0U);
  EXPECT_EQ(schedule.served_ps(), 7 * 25'000U);
}

// Counted one by one.
TEST(MemorySchedule, KnowsHowManyLinesHaveBegun) {
  const video::Timing timing = small_screen();
  const MemorySchedule schedule(25'000, timing, 6, 30);
  std::uint64_t begun = 0;
  for (std::uint64_t clock = 0; clock < 3 * timing.frame.count(); ++clock) {
    const std::uint64_t now = timing.clock.picoseconds(Cycles(clock));
    ASSERT_EQ(schedule.bursts_before(now), begun) << "clock " << clock;
    for (std::size_t line = 0; line < 6; ++line)
      if (timing.line_start(line).count() == clock % timing.frame.count()) ++begun;
    ASSERT_EQ(schedule.bursts_before(now + 1), begun) << "just after clock " << clock;
  }
  EXPECT_EQ(begun, 18U);
  EXPECT_EQ(MemorySchedule(25'000, std::nullopt, 6, 30).bursts_before(1'000'000'000), 0U);
}

// A line is 7500 ns, its reads are 20 and one access may be under way: 357.142 ns fit, a picosecond more does not.
TEST(MemorySchedule, ASharedPortMustHaveReadALineBeforeTheNext) {
  FrameStoreParameters parameters;
  const auto complaints = [&] {
    Diagnostics diagnostics;
    const MemoryLayout layout = MemoryLayout::of(parameters, 20, 6, 24, false);
    check_scan_out(parameters, layout, small_screen(), "machine.toml", diagnostics);
    return diagnostics.list();
  };
  parameters.scan_out = ScanOut::shared;
  parameters.access_ns = 357.142;
  EXPECT_TRUE(complaints().empty());
  parameters.access_ns = 357.143;
  ASSERT_EQ(complaints().size(), 1U);
  EXPECT_EQ(complaints()[0].key, "frame_store.scan_out");
  EXPECT_NE(complaints()[0].message.find("at most 357.142 ns"), std::string::npos) << complaints()[0].message;
  parameters.banks = 2;
  EXPECT_TRUE(complaints().empty());
  parameters.banks = 1;
  parameters.scan_out = ScanOut::separate;
  EXPECT_TRUE(complaints().empty());
}

TEST(FrameStoreParameters, AccessTimesAreWholePicoseconds) {
  FrameStoreParameters parameters;
  parameters.access_ns = 25.0001;
  Diagnostics diagnostics;
  parameters.check("machine.toml", diagnostics);
  ASSERT_EQ(diagnostics.list().size(), 1U);
  EXPECT_EQ(diagnostics.list()[0].key, "frame_store.access_ns");
}

}  // namespace
}  // namespace rastertlm::frame_store
