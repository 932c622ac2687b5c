// What the screen shows of solids of a host that is late, where loading RAMs are copied at every retrace: the words
// that stand by then, of a slot that is half written those of two poses.
#include "modules/host/quadric_computation.h"
#include "modules/object_processor/line_composer.h"
#include "modules/quadric_processor/quadric_board.h"
#include "src/run/inputs.h"
#include "tests/platforms/imogene/host_timeline.h"
#include "tests/platforms/imogene/simulation.h"
#include "tests/platforms/imogene/solid_scenes.h"

namespace rastertlm::test {
namespace {

constexpr std::size_t kColumns = 144;
constexpr std::size_t kLines = 112;
constexpr std::uint64_t kSlotWords = 31 + 9 * 6;
constexpr std::uint64_t kBusCycles = 1500;
constexpr std::uint64_t kAllWords = ~0ULL;

// A unit with nothing but solids, and its board, without the machine around them.
class LoneUnit {
 public:
  explicit LoneUnit(const run::Inputs& inputs)
      : scene_(*inputs.content->scene),
        machine_(inputs.content->object_machine("this test")),
        board_(machine_.quadric, {kColumns, kLines, 24, imogene::depth_range(machine_)}, 64, 0),
        composer_(machine_.object_processor, kColumns) {
    std::vector<host::SlotOwner> owners;
    for (const scene::Object& object : scene_.objects) {
      const auto number = static_cast<std::uint32_t>(owners.size());
      resident_.objects.push_back({nullptr, false, true, &*object.solid});
      owners.push_back({number, number});
    }
    resident_.pose = [this](std::int64_t frame) { return scene::pose(scene_, frame, kColumns, kLines); };
    computation_.emplace(
        resident_, set_up::QuadricFormat{machine_.quadric, {24, kColumns, kLines, machine_.object_processor.edges}},
        owners);
  }
  LoneUnit(const LoneUnit&) = delete;
  LoneUnit& operator=(const LoneUnit&) = delete;

  // The words of a pose, none of which is written yet. Returns how many they are.
  std::uint64_t set_up(std::int64_t animation_frame, bool initial) {
    loads_ = computation_->set_up(host::Animation(resident_, false).frame_work(animation_frame, initial));
    written_ = 0;
    std::uint64_t words = 0;
    for (const host::QuadricLoad& load : loads_) words += load.park ? quadric_processor::kParkWords : kSlotWords;
    return words;
  }
  // How many of them have been written `cycles` host cycles after the arithmetic began: each slot's words follow the
  // arithmetic up to it, 1500 cycles each on the bus.
  std::uint64_t words_by(std::uint64_t cycles) const {
    std::uint64_t words = 0;
    for (std::size_t i = 0; i < loads_.size(); ++i)
      for (std::uint64_t left = loads_[i].park ? quadric_processor::kParkWords : kSlotWords; left > 0; --left, ++words)
        if (arithmetic(computation_->before()[i].flops()) + kBusCycles * (words + 1) > cycles) return words;
    return words;
  }
  // The first `words` of them stand in the loading RAMs.
  void write_up_to(std::uint64_t words) {
    std::uint64_t before = 0;
    for (const host::QuadricLoad& load : loads_) {
      const std::uint64_t size = load.park ? quadric_processor::kParkWords : kSlotWords;
      const quadric_processor::QuadricImage image = quadric_processor::to_image(load.words);
      const std::uint64_t from = std::max(before, written_), to = std::min(before + size, words);
      if (from < to) board_.write_words(load.slot, from - before, std::span(image).subspan(from - before, to - from));
      before += size;
    }
    written_ = std::max(written_, words);
  }
  std::size_t pixels_that_differ(const frame::Frame& shown) {
    board_.copy();
    frame::FragmentLine line;
    line.resize(kColumns);
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < kLines; ++y) {
      const frame::CoveredLine* covered = nullptr;
      board_.cover_lines(y, 1, 1, &covered);
      composer_.compose({&covered, 1}, y, line);
      for (std::size_t x = 0; x < kColumns; ++x) {
        const bool seen = x >= line.begin && x < line.end && line.object[x] != 0;
        const std::size_t at = y * kColumns + x;
        if (shown.object[at] != (seen ? line.object[x] : 0) || shown.depth[at] != (seen ? line.depth[x] : 0xFFFFFF))
          ++wrong;
      }
    }
    return wrong;
  }

 private:
  const scene::Scene& scene_;
  const imogene::Machine& machine_;
  host::ResidentScene resident_;
  std::optional<host::QuadricComputation> computation_;
  quadric_processor::QuadricBoard board_;
  object_processor::LineComposer composer_;
  std::vector<host::QuadricLoad> loads_;
  std::uint64_t written_ = 0;
};

class TornSolidsTest : public SimulationTest {
 protected:
  // Twelve that turn about the middle, the outer ones out of view and back.
  std::string scene() const {
    std::string solids;
    for (int i = 0; i < 12; ++i) {
      const int row = i / 4;
      solids += fmt::format(
          "[[object]]\ntype = \"{}\"\nmaterial = \"glaze\"\nradius = 0.6\n{}translate = [{}, 0.0, {}]\n"
          "[[object.animation]]\ntype = \"orbit\"\naxis = [0.1, 1.0, 0.2]\ndeg_per_frame = 25.0\n",
          i % 2 == 0 ? "sphere" : "cone", i % 2 == 0 ? "" : "height = 1.0\n", -2.4 + 1.6 * (i % 4), -2.9 + 2.9 * row);
    }
    return written("turned.toml", scene_of(solids));
  }
  static std::vector<std::string> set(const std::string& swap) {
    return {"video.columns=144", "video.lines=112", "host.computation_units=1", "host.bus_cycles_per_word=1500",
            "host.swap=" + swap};
  }
  // The pose that follows the one that is shown in frame k, or nothing.
  static std::optional<std::int64_t> next_pose(const run::Result& result, std::size_t k) {
    for (std::size_t later = k; later < result.frames.size(); ++later)
      if (result.frames[later].animation_frame != result.frames[k].animation_frame)
        return result.frames[later].animation_frame;
    return std::nullopt;
  }
};

// As many words as the report says are ahead have been written, in the order of slots.
TEST_F(TornSolidsTest, AreTheWordsThatHadBeenWritten) {
  constexpr std::uint64_t kFrames = 12;
  const std::string file = scene();
  const Simulated simulated =
      simulate(kQuadricMachine, file, {.set = set("unconditional"), .frames = kFrames, .reference = false});
  const run::Inputs inputs = run::read_inputs(kQuadricMachine, file, set("unconditional"));
  LoneUnit unit(inputs);
  unit.set_up(0, true);
  unit.write_up_to(kAllWords);
  bool begun = false;  // the next update has words that are in use
  std::uint64_t torn = 0, within_a_slot = 0, updates = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    SCOPED_TRACE(k);
    const run::FrameFigures& figures = simulated.result.frames[k];
    if (k > 0 && figures.animation_frame != simulated.result.frames[k - 1].animation_frame) {
      if (!begun) unit.set_up(figures.animation_frame, false);
      unit.write_up_to(kAllWords);
      begun = false;
      ++updates;
    }
    if (figures.words_ahead > 0) {
      const auto next = next_pose(simulated.result, k);
      if (!next) break;
      if (!begun) {
        EXPECT_LT(figures.words_ahead, unit.set_up(*next, false));
      }
      begun = true;
      unit.write_up_to(figures.words_ahead);
      ++torn;
      within_a_slot += figures.words_ahead % kSlotWords != 0 ? 1U : 0U;
    }
    EXPECT_EQ(unit.pixels_that_differ(simulated.shown[k]), 0U) << figures.words_ahead << " words ahead";
  }
  EXPECT_GE(torn, 4U);
  EXPECT_GE(within_a_slot, 3U);
  EXPECT_GE(updates, 2U);
  EXPECT_GE(simulated.result.answer.torn_frames, torn);
}

// Which these are follows from time: the messages about twelve objects to one unit, its report and the plan,
// arithmetic, and words on the bus. A copy stops the bus for 14 pixel clocks, 17 host cycles, which moves no word into
// another frame.
TEST_F(TornSolidsTest, AreTheWordsThatThereWasTimeFor) {
  constexpr std::uint64_t kFrames = 12;
  const std::string file = scene();
  const Simulated simulated =
      simulate(kQuadricMachine, file, {.set = set("unconditional"), .frames = kFrames, .reference = false});
  const run::Inputs inputs = run::read_inputs(kQuadricMachine, file, set("unconditional"));
  LoneUnit unit(inputs);
  unit.set_up(0, true);
  unit.set_up(1, false);
  UpdateWork work;
  work.message_bytes = 8 + 64 * 12;
  work.units.resize(1);
  const std::uint64_t begun = timeline(work, {-1}).fits.at(0);
  std::uint64_t torn = 0;
  for (std::size_t k = 1; k < kFrames && simulated.result.frames[k].animation_frame == 0; ++k, ++torn)
    EXPECT_EQ(simulated.result.frames[k].words_ahead, unit.words_by(k * kFramePs / kHostPs - begun)) << k;
  EXPECT_GE(torn, 2U);
}

// With one swap for all the same machine shows whole pictures, at the same rate.
TEST_F(TornSolidsTest, NoneWhereAllSwapTogether) {
  constexpr std::uint64_t kFrames = 12;
  const std::string file = scene();
  const Simulated torn =
      simulate(kQuadricMachine, file, {.set = set("unconditional"), .frames = kFrames, .reference = false});
  const Simulated whole =
      simulate(kQuadricMachine, file, {.set = set("global"), .frames = kFrames, .reference = false});
  EXPECT_EQ(whole.result.answer.torn_frames, 0U);
  EXPECT_EQ(whole.result.answer.update_rate_hz, torn.result.answer.update_rate_hz);
  std::uint64_t updates = 0;
  for (std::size_t k = 1; k < kFrames; ++k) {
    EXPECT_EQ(whole.result.frames[k].words_ahead, 0U);
    const bool updated = whole.result.frames[k].animation_frame != whole.result.frames[k - 1].animation_frame;
    EXPECT_EQ(same_picture(whole.shown[k], whole.shown[k - 1]), !updated) << k;
    if (!updated || torn.result.frames[k].words_ahead > 0) continue;
    ++updates;
    EXPECT_TRUE(same_picture(whole.shown[k], torn.shown[k])) << k;
  }
  EXPECT_GE(updates, 1U);
}

}  // namespace
}  // namespace rastertlm::test
