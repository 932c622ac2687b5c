// What the screen shows of a host that is late, where loading RAMs are copied at every retrace: a picture of the words
// that had been written by then. Which words those are is worked out here from the host's timeline, and what they draw
// by looking at every pixel of every processor.
#include <array>
#include <map>

#include "tests/platforms/imogene/host_timeline.h"
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

constexpr std::uint32_t kColumns = 96;
constexpr std::uint32_t kLines = 80;
constexpr std::uint32_t kSlots = 512;
constexpr std::uint32_t kWordMask = 0xFFFFFF;
constexpr std::uint32_t kSign = 0x800000;

struct Slot {
  std::array<std::uint32_t, kWords> words{};
  std::uint32_t object = 0;
  bool written = false;
};
using Boards = std::vector<std::vector<Slot>>;

// The first `words` words of a unit's writes.
void write(const UnitWork& work, std::uint64_t words, std::vector<Slot>& slots) {
  for (const Write& one : work.writes) {
    Slot& slot = slots.at(one.load.slot);
    const auto all = object_processor::to_words(one.load.words);
    const std::uint64_t now = std::min(words, one.words);
    for (std::size_t i = 0; i < now; ++i) slot.words[i] = all[i] & kWordMask;
    if (now > 0) slot.written = true;
    if (now > 0 && !one.load.park) slot.object = one.load.object + 1;
    words -= now;
  }
}

// How many words of a unit stand `cycles` host cycles after the retrace that started it: each slot's follow the
// arithmetic up to it. (No copy before this one found a word on the bus.)
std::uint64_t words_by(const UnitWork& work, std::uint64_t fits, std::uint64_t cycles) {
  std::uint64_t written = 0;
  for (const Write& one : work.writes)
    for (std::uint64_t i = 0; i < one.words; ++i) {
      if (fits + arithmetic(one.before) + 3 * (written + 1) > cycles) return written;
      ++written;
    }
  return written;
}

struct Pixel {
  std::uint32_t object = 0;
  std::uint32_t depth = kWordMask;
};

// A x + B (y + 1) + C in 24 bits, at every pixel, of every processor.
Pixel shown_at(const Boards& boards, std::uint32_t x, std::uint32_t y) {
  Pixel pixel;
  for (const auto& board : boards)
    for (const Slot& slot : board) {
      if (!slot.written) continue;
      const auto word = [&](std::size_t ep) {
        return (slot.words[3 * ep] * x + slot.words[3 * ep + 1] * (y + 1) + slot.words[3 * ep + 2]) & kWordMask;
      };
      if (((word(0) | word(1) | word(2)) & kSign) != 0 || word(3) >= pixel.depth) continue;
      pixel = {slot.object, word(3)};
    }
  return pixel;
}

void expect_shows(const frame::Frame& frame, const Boards& boards) {
  std::size_t wrong = 0;
  for (std::uint32_t y = 0; y < kLines; ++y)
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const Pixel pixel = shown_at(boards, x, y);
      const std::size_t at = y * kColumns + x;
      if (frame.object[at] != pixel.object || frame.depth[at] != pixel.depth) ++wrong;
    }
  EXPECT_EQ(wrong, 0U);
}

class TornPictureTest : public SimulationTest {
 protected:
  static constexpr std::uint64_t kFrames = 6;
  std::string scene() const {
    return written("scene.toml", scene_of("[[object]]\ntype = \"teapot\"\nscale = [0.7, 0.7, 0.7]\n"
                                          "[[object.animation]]\ntype = \"spin\"\naxis = [0.0, 0.0, 1.0]\n"
                                          "deg_per_frame = 20.0\n"));
  }
  static std::vector<std::string> set(const std::string& swap) {
    return {"video.columns=" + std::to_string(kColumns), "video.lines=" + std::to_string(kLines),
            "host.computation_units=2", "host.processors_per_unit=" + std::to_string(kSlots), "host.swap=" + swap};
  }
};

// Two boards need four frames for the teapot; the words of their triangles come in the last one and a half of them.
TEST_F(TornPictureTest, AreTheWordsThatHadBeenWritten) {
  const std::string file = scene();
  const run::Inputs inputs = run::read_inputs(kMachine, file, set("unconditional"));
  const Simulated simulated = simulate(kMachine, file, {.set = set("unconditional"), .frames = kFrames});
  Units units(inputs);
  Boards boards(2, std::vector<Slot>(kSlots));
  const UpdateWork first = units.update(0, true);
  for (std::size_t k = 0; k < 2; ++k) write(first.units[k], first.units[k].words, boards[k]);
  expect_shows(simulated.shown[0], boards);
  EXPECT_EQ(simulated.result.frames[0].words_ahead, 0U);

  const UpdateWork work = units.update(1, false);
  const Schedule schedule = timeline(work, kTwo);
  std::uint64_t torn = 0;
  for (std::uint64_t frame = 1; frame <= 4; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const std::uint64_t ended = frame * kFramePs / kHostPs;  // host cycles that ended before this retrace
    std::uint64_t ahead = 0;
    Boards then = boards;
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_LT(schedule.fits[k], 3 * kFramePs / kHostPs) << "the third retrace is meant to find some words";
      const std::uint64_t words = words_by(work.units[k], schedule.fits[k], ended);
      write(work.units[k], words, then[k]);
      ahead += words;
    }
    expect_shows(simulated.shown[frame], then);
    const bool finished = frame == 4;
    EXPECT_EQ(simulated.result.frames[frame].words_ahead, finished ? 0 : ahead);
    EXPECT_EQ(simulated.result.frames[frame].animation_frame, finished ? 1 : 0);
    torn += !finished && ahead > 0 ? 1U : 0U;
  }
  EXPECT_GE(torn, 1U);
  EXPECT_EQ(simulated.result.answer.torn_frames, torn);
  EXPECT_FALSE(same_picture(simulated.shown[3], simulated.shown[0]));
  EXPECT_FALSE(same_picture(simulated.shown[3], simulated.shown[4]));
}

// The same machine with one swap for all shows whole pictures, at the same rate.
TEST_F(TornPictureTest, NoneWhereAllSwapTogether) {
  const std::string file = scene();
  const Simulated whole = simulate(kMachine, file, {.set = set("global"), .frames = kFrames});
  const Simulated torn = simulate(kMachine, file, {.set = set("unconditional"), .frames = kFrames});
  EXPECT_EQ(whole.result.answer.torn_frames, 0U);
  EXPECT_GT(torn.result.answer.torn_frames, 0U);
  EXPECT_EQ(whole.result.answer.update_rate_hz, torn.result.answer.update_rate_hz);
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    if (frame % 4 != 0)
      EXPECT_TRUE(same_picture(whole.shown[frame], whole.shown[frame - 1])) << frame;
    else
      EXPECT_TRUE(same_picture(whole.shown[frame], torn.shown[frame])) << frame;
    EXPECT_EQ(whole.result.frames[frame].words_ahead, 0U);
  }
}

// A host that is in time never tears a picture.
TEST_F(TornPictureTest, NoneOfAHostThatIsInTime) {
  std::vector<std::string> fast = set("unconditional");
  fast.emplace_back("host.preset=soft_core");
  const Simulated simulated = simulate(kMachine, scene(), {.set = fast, .frames = kFrames});
  EXPECT_TRUE(simulated.result.answer.sustained);
  EXPECT_EQ(simulated.result.answer.torn_frames, 0U);
  expect_exact(simulated, 5, 3);
}

}  // namespace
}  // namespace rastertlm::test
