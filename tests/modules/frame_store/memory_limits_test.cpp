// Do the closed forms of what a memory can serve say what its schedule does?
#include "modules/frame_store/memory_limits.h"

#include <gtest/gtest.h>

#include "modules/frame_store/memory_schedule.h"
#include "tests/modules/frame_store/small_screen.h"

namespace rastertlm::frame_store {
namespace {

struct Memory {
  FrameStoreParameters parameters;
  video::Timing timing = small_screen();
  MemoryLayout layout() const { return MemoryLayout::of(parameters, 20, 6, 24, false); }
  MemoryLimits limits() const { return {parameters, layout(), timing}; }

  // A clear and `screens` whole screens, the first so many of which win, line by line.
  std::uint64_t accesses(std::uint64_t screens, std::uint64_t winning) const {
    const std::uint64_t all = ~std::uint64_t{0};
    std::uint64_t sum = parameters.clear ? layout().clear_accesses() : 0;
    for (std::uint64_t screen = 0; screen < screens; ++screen)
      for (std::uint64_t line = 0; line < 6; ++line)
        sum += layout().span_accesses(0, 20, screen < winning ? 20 : 0, &all);
    return sum;
  }
  // One after the other, from the start.
  double seconds(std::uint64_t accesses) const {
    const bool shared = parameters.scan_out == ScanOut::shared;
    MemorySchedule schedule(parameters.access_ps(), shared ? std::optional(timing) : std::nullopt, 6,
                            layout().line_accesses());
    return 1e-12 * static_cast<double>(schedule.serve(0, accesses));
  }
};

std::vector<Memory> memories() {
  std::vector<Memory> all;
  for (const std::int64_t width : {16, 64, 128})
    for (const std::int64_t banks : {1, 3})
      for (const bool test : {true, false})
        for (const ScanOut scan_out : {ScanOut::separate, ScanOut::shared}) {
          Memory memory;
          memory.parameters.width_bits = width;
          memory.parameters.banks = banks;
          memory.parameters.depth_test = test;
          memory.parameters.clear = test;
          memory.parameters.scan_out = scan_out;
          all.push_back(memory);
        }
  return all;
}

TEST(MemoryLimits, CountWhatSpansOfWholeLinesTake) {
  for (const Memory& memory : memories())
    for (const std::uint64_t winning : {0U, 1U, 3U})
      EXPECT_DOUBLE_EQ(memory.limits().accesses(4, static_cast<double>(winning)),
                       static_cast<double>(memory.accesses(4, winning)));
}

// Over many video frames, to within what bursts of one of them take.
TEST(MemoryLimits, TakeTheTimeThatTheScheduleTakes) {
  bool any_shared = false;
  for (const Memory& memory : memories()) {
    constexpr std::uint64_t kAccesses = 2'000'000;
    const double seconds = memory.seconds(kAccesses);
    const double slack =
        memory.parameters.scan_out == ScanOut::shared ? memory.timing.clock.seconds(memory.timing.frame) : 1e-12;
    EXPECT_NEAR(memory.limits().seconds(kAccesses), seconds, slack);
    any_shared = any_shared || memory.limits().drawing_share() < 0.9;
  }
  EXPECT_TRUE(any_shared);
}

// From a retrace on, to within a burst: what a video frame has for drawing at its start no line disturbs.
TEST(MemoryLimits, TakeLessTimeInTheRetraceThanInTheLines) {
  for (const Memory& memory : memories()) {
    const double burst = 1e-9 * memory.parameters.access_ns * static_cast<double>(memory.layout().line_accesses() + 1);
    for (std::uint64_t accesses = 1; accesses < 2'000; accesses += 13)
      EXPECT_NEAR(memory.limits().seconds(static_cast<double>(accesses)), memory.seconds(accesses), burst) << accesses;
  }
}

// What fits to the brim takes exactly the time that there is; by either limit.
TEST(MemoryLimits, AreReachedTogether) {
  for (const Memory& memory : memories()) {
    constexpr double kSecond = 1.0;
    const double complexity = memory.limits().complexity_within(kSecond);
    ASSERT_GT(complexity, 100.0);
    EXPECT_NEAR(memory.limits().seconds(memory.limits().accesses(complexity, complexity)), kSecond, 1e-9);
    Memory slower = memory;
    const double accesses = memory.limits().accesses(4000, 20);  // quick enough to read a line in a line's time
    slower.parameters.access_ns = memory.limits().access_ns_within(accesses, kSecond);
    EXPECT_NEAR(slower.limits().seconds(accesses), kSecond, 1e-9);
  }
}

TEST(MemoryLimits, NothingFitsWhereTheClearDoesNot) {
  Memory memory;
  EXPECT_EQ(memory.limits().complexity_within(119 * 25e-9), 0.0);  // 120 words to clear
  EXPECT_GT(memory.limits().complexity_within(121 * 25e-9), 0.0);
}

// A pixel of 50 ns that is read and written leaves 25 ns for each; two banks, or two pixels a word, twice that.
TEST(MemoryLimits, AreOfASpanUnit) {
  Memory memory;
  EXPECT_DOUBLE_EQ(memory.limits().access_ns_of_pixel(50.0), 25.0);
  memory.parameters.banks = 2;
  EXPECT_DOUBLE_EQ(memory.limits().access_ns_of_pixel(50.0), 50.0);
  memory.parameters.banks = 1;
  memory.parameters.width_bits = 96;
  EXPECT_DOUBLE_EQ(memory.limits().access_ns_of_pixel(50.0), 50.0);
  memory.parameters.depth_test = false;  // four pixels of 24 bits a word
  EXPECT_DOUBLE_EQ(memory.limits().access_ns_of_pixel(50.0), 200.0);
}

// Two pictures of 20 x 6 pixels, a word each: 240 words in 8 bits of address.
TEST(MemoryLimits, CountPins) {
  Memory memory;
  const MemoryPins pins = memory_pins(memory.parameters, memory.layout());
  EXPECT_EQ(pins.data, 64U);
  EXPECT_EQ(pins.address, 8U);
  EXPECT_EQ(pins.control, 1U);
  memory.parameters.banks = 4;  // 60 words each
  EXPECT_EQ(memory_pins(memory.parameters, memory.layout()).all(), 4U * (64 + 6 + 1));
}

}  // namespace
}  // namespace rastertlm::frame_store
