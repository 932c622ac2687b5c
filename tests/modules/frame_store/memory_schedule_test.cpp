// Does the memory serve in the order of the rules, and how many accesses does a span take?
#include "modules/frame_store/memory_schedule.h"

#include <gtest/gtest.h>

#include <random>

namespace rastertlm::frame_store {
namespace {

video::Timing small_screen() {
  video::VideoParameters parameters;
  parameters.columns = 20;
  parameters.lines = 6;
  parameters.refresh_hz = 20000;
  parameters.pixel_clock_ns = 100;
  parameters.vertical_retrace_us = 5;
  return video::timing(parameters);
}

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

TEST(MemoryLayout, CountsTheAccessesOfTheBusiestBank) {
  FrameStoreParameters parameters;
  parameters.width_bits = 64;
  const auto layout = [&] { return MemoryLayout::of(parameters, 512, 512, 24, false); };
  EXPECT_EQ(layout().pixels_a_word, 1U);  // 48 bits
  EXPECT_EQ(layout().span_accesses(3, 10, 4, true), 10U + 4);
  EXPECT_EQ(layout().span_accesses(3, 10, 10, false), 10U);
  parameters.width_bits = 96;
  EXPECT_EQ(layout().pixels_a_word, 2U);
  EXPECT_EQ(layout().span_accesses(3, 10, 0, true), 6U);  // 3, 4-5 ... 12
  EXPECT_EQ(layout().span_accesses(4, 10, 0, true), 5U);
  parameters.banks = 4;
  EXPECT_EQ(layout().span_accesses(3, 10, 10, true), 2U + 2);
  parameters.width_bits = 16;
  parameters.banks = 1;
  EXPECT_EQ(layout().depth_words, 2U);
  EXPECT_EQ(layout().write_words, 3U);
  EXPECT_EQ(layout().span_accesses(0, 10, 10, true), 20U + 30);
  EXPECT_EQ(layout().line_accesses(), 512U * 2);
  EXPECT_EQ(layout().clear_accesses(), 512U * 512 * 3);
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
