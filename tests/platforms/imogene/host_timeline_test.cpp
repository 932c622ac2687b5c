// How long the host takes for a frame, and what the screen shows meanwhile: as the timeline of host_timeline.h says.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "platforms/imogene/imogene.h"
#include "tests/platforms/imogene/host_timeline.h"
#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

struct Update {
  std::int64_t animation_frame = 0;
  std::uint64_t cycles = 0, computing = 0, writing = 0, flops = 0, words = 0;
};

// What the machine's units did: one list a unit.
std::vector<std::vector<Update>> updates_of(const run::Inputs& inputs, std::uint64_t frames) {
  const std::string text = in_child([&] {
    imogene::Imogene platform(inputs.content->object_machine("this test"), *inputs.content->scene, {frames, false}, {});
    platform.run();
    std::ostringstream out;
    for (const auto& unit : platform.computation_units()) {
      out << unit->updates().size() << '\n';
      for (const auto& u : unit->updates())
        out << u.animation_frame << ' ' << u.cycles.count() << ' ' << u.computing.count() << ' ' << u.writing.count()
            << ' ' << u.flops() << ' ' << u.words << '\n';
    }
    return out.str();
  });
  std::istringstream in(text);
  std::vector<std::vector<Update>> all;
  for (std::size_t count = 0; in >> count;) {
    std::vector<Update>& unit = all.emplace_back(count);
    for (Update& u : unit) in >> u.animation_frame >> u.cycles >> u.computing >> u.writing >> u.flops >> u.words;
  }
  return all;
}

std::uint64_t video_frames(std::uint64_t host_cycles) { return (host_cycles * kHostPs + kFramePs - 1) / kFramePs; }

struct Host {
  const char* name;
  Parents parents;
  std::uint64_t processors;  // of a unit
  std::vector<std::string> set;
  std::uint64_t late;  // video frames an update takes; 0: not said
};

std::ostream& operator<<(std::ostream& out, const Host& host) { return out << host.name; }

class HostTimelineTest : public SimulationTest, public testing::WithParamInterface<Host> {
 protected:
  static constexpr std::uint64_t kFrames = 9;

  std::vector<std::string> set() const {
    std::vector<std::string> all{"video.columns=128", "video.lines=128",
                                 "host.computation_units=" + std::to_string(GetParam().parents.size()),
                                 "host.processors_per_unit=" + std::to_string(GetParam().processors)};
    all.insert(all.end(), GetParam().set.begin(), GetParam().set.end());
    return all;
  }

  // Every object of the scene moves.
  void expect_timeline(const std::string& scene_file) const {
    const run::Inputs inputs = run::read_inputs(kMachine, scene_file, set());
    const Simulated simulated = simulate(kMachine, scene_file, {.set = set(), .frames = kFrames});
    const auto updates = updates_of(inputs, kFrames);
    ASSERT_EQ(updates.size(), GetParam().parents.size());
    Units units(inputs);

    // The first update is the initial load. The next one starts when a frame is displayed, for the video frame that
    // follows.
    std::uint64_t displayed = 0;       // at which the update in hand shows
    std::uint64_t slowest_cycles = 0;  // of those after the first picture
    std::int64_t animation_frame = 0;
    for (std::size_t i = 0; i < updates[0].size(); ++i) {
      SCOPED_TRACE("update " + std::to_string(i));
      const UpdateWork work = units.update(animation_frame, i == 0);
      const std::vector<std::uint64_t> done = timeline(work, GetParam().parents).done;
      for (std::size_t k = 0; k < done.size(); ++k)
        if (i < updates[k].size()) {
          SCOPED_TRACE("unit " + std::to_string(k));
          EXPECT_EQ(updates[k][i].animation_frame, animation_frame);
          expect_update(updates[k][i], work.units[k], done[k]);
          if (i > 0) slowest_cycles = std::max(slowest_cycles, done[k]);
        }
      const std::uint64_t takes = video_frames(*std::max_element(done.begin(), done.end()));
      if (i == 0) {
        EXPECT_EQ(simulated.result.answer.initial_load_frames, takes);
      } else {
        expect_late(simulated, displayed, displayed + takes);
        displayed += takes;
      }
      if (displayed < kFrames) expect_shown(simulated.result.frames[displayed], animation_frame, work);
      animation_frame = static_cast<std::int64_t>(displayed) + 1;
    }
    ASSERT_GE(displayed + video_frames(slowest_cycles), kFrames) << "not all frames were looked at";
    expect_answer(simulated.result, slowest_cycles);
  }

  static void expect_update(const Update& update, const UnitWork& work, std::uint64_t cycles) {
    EXPECT_EQ(update.flops, work.flops());
    EXPECT_EQ(update.words, work.words);
    EXPECT_EQ(update.computing, arithmetic(work.first_flops) + arithmetic(work.second_flops));
    EXPECT_EQ(update.writing, 3 * work.words);
    EXPECT_EQ(update.cycles, cycles);
  }

  static void expect_shown(const run::FrameFigures& frame, std::int64_t animation_frame, const UpdateWork& work) {
    EXPECT_EQ(frame.animation_frame, animation_frame);
    std::uint64_t words = 0;
    std::uint64_t flops = 0;
    for (const UnitWork& unit : work.units) {
      words += unit.words;
      flops += unit.flops();
    }
    EXPECT_EQ(frame.words_sent, words);
    EXPECT_EQ(frame.host_flops, flops);
  }

  static void expect_answer(const run::Result& result, std::uint64_t slowest_cycles) {
    const std::uint64_t slowest = video_frames(slowest_cycles);
    EXPECT_NEAR(result.answer.update_rate_hz, kDisplayHz / static_cast<double>(slowest), 1e-6);
    EXPECT_EQ(result.answer.latency_frames, slowest);
    EXPECT_EQ(result.answer.sustained, slowest == 1);
    const run::Budget& budget = named(result.budgets, "host.update");
    EXPECT_DOUBLE_EQ(budget.used, static_cast<double>(slowest_cycles));
    EXPECT_EQ(budget.available, 399'999);  // of 50 ns, whole in 19.99998 ms
    if (GetParam().late != 0) {
      EXPECT_EQ(slowest, GetParam().late);
    }
    for (const run::FrameFigures& frame : result.frames) {
      EXPECT_EQ(error_of(frame, "snapped").covered_missing, 0U);
      EXPECT_EQ(error_of(frame, "snapped").covered_extra, 0U);
    }
  }

  // Between two updates the picture stays, and nothing is computed for it; at an update it changes.
  static void expect_late(const Simulated& simulated, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t k = from + 1; k < to && k < kFrames; ++k) {
      EXPECT_TRUE(same_picture(simulated.shown[k], simulated.shown[k - 1])) << "frame " << k;
      EXPECT_EQ(simulated.result.frames[k].animation_frame, simulated.result.frames[from].animation_frame);
      EXPECT_EQ(simulated.result.frames[k].host_flops, 0U);
      EXPECT_EQ(simulated.result.frames[k].words_sent, 0U);
    }
    if (to < kFrames) {
      EXPECT_NE(simulated.shown[to].rgb, simulated.shown[to - 1].rgb) << "frame " << to;
    }
  }
};

TEST_P(HostTimelineTest, IsThatOfItsOperationsMessagesAndWords) { expect_timeline(kTeapot); }

// Eight boards need nine tenths of a frame: half of them, two frames; a quarter, four.
INSTANTIATE_TEST_SUITE_P(Imogene, HostTimelineTest,
                         testing::Values(Host{"EightBoards", kEight, 128, {}, 1}, Host{"FourBoards", kFour, 256, {}, 2},
                                         Host{"TwoBoards", kTwo, 512, {}, 4},
                                         Host{"ChainOfFour", kChainOfFour, 256, {"host.link_topology=chain"}, 2},
                                         Host{"ThreeBoardsInBlocks", kThree, 512, {"host.assignment=block"}, 0}),
                         [](const auto& host) { return std::string(host.param.name); });

// Pieces that find no processor on their own board travel up with the surveys and down with the plan.
class PieceTimelineTest : public HostTimelineTest {};

TEST_P(PieceTimelineTest, CountsThePiecesThatTravel) {
  const std::string scene = written("pieces.toml", scene_of(std::string(kSphere) + "two_sided = true\n" + kSpin,
                                                            std::string(kCamera) + "near = 9.1\n"));
  const run::Inputs inputs = run::read_inputs(kMachine, scene, set());
  Units units(inputs);
  ASSERT_GT(units.update(0, true).placed, 20U);
  expect_timeline(scene);
}

INSTANTIATE_TEST_SUITE_P(
    Imogene, PieceTimelineTest,
    testing::Values(Host{"Tree", kThree, 360, {"host.assignment=block"}, 0},
                    Host{"Chain", kChainOfFour, 240, {"host.assignment=block", "host.link_topology=chain"}, 0}),
    [](const auto& host) { return std::string(host.param.name); });

class BoundaryTest : public SimulationTest {
 protected:
  // So many small triangles that turn, one beside the other.
  std::string triangles(std::size_t count) const {
    std::string positions;
    for (std::size_t i = 0; i < count; ++i) {
      positions += fmt::format("[0.{0}, 0.0, 0.0], [1.0, 0.0, 0.{0}], [0.0, 0.{0}, 1.0], ", i);
    }
    return written("triangles.toml", scene_of("[[object]]\ntype = \"triangles\"\ntwo_sided = true\npositions = [" +
                                              positions + "]\n" + kSpin));
  }
  static std::vector<std::string> set(std::uint64_t link_set_up) {
    return {"video.columns=64", "video.lines=64", "host.computation_units=1",
            "host.link_set_up_cycles=" + std::to_string(link_set_up)};
  }
};

// 399,999 host cycles end within the frame of 19.99998 ms, the 400,000th does not. One unit: three messages, whose
// start is stretched until the update takes exactly that; the number of triangles settles what is left over modulo 3.
TEST_F(BoundaryTest, OneCycleMoreThanAFrameIsLate) {
  constexpr std::uint64_t kDefaultSetUp = 19;
  for (const std::uint64_t wanted : {399'999ULL, 400'000ULL}) {
    SCOPED_TRACE(wanted);
    bool found = false;
    for (std::size_t count = 1; count <= 9 && !found; ++count) {
      const std::string scene = triangles(count);
      const run::Inputs inputs = run::read_inputs(kMachine, scene, set(kDefaultSetUp));
      Units units(inputs);
      units.update(0, true);
      const std::uint64_t cycles = timeline(units.update(1, false), {-1}).done.at(0);
      if ((wanted - cycles) % 3 != 0) continue;
      found = true;
      const std::uint64_t late = wanted == 400'000 ? 1 : 0;
      const Simulated simulated = simulate(
          kMachine, scene, {.set = set(kDefaultSetUp + (wanted - cycles) / 3), .frames = 2, .reference = false});
      EXPECT_EQ(named(simulated.result.budgets, "host.update").used, static_cast<double>(wanted));
      EXPECT_EQ(named(simulated.result.budgets, "host.update").fits, late == 0);
      EXPECT_EQ(simulated.result.answer.latency_frames, 1 + late);
      EXPECT_EQ(simulated.result.frames.at(1).animation_frame, late == 0 ? 1 : 0);
    }
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace rastertlm::test
