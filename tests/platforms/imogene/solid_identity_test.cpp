// The same picture of solids whatever is simulated, however the nearest is found, whoever draws which, when fragments
// meet, and whichever vector instructions compute it; and of what is dropped or refused, what is left.
#include <cstdlib>
#include <map>

#include "src/base/vector_variant.h"
#include "tests/platforms/imogene/simulation.h"
#include "tests/platforms/imogene/solid_scenes.h"
#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

using View = SolidScene::View;

constexpr std::size_t kColumns = 144;
constexpr std::size_t kLines = 112;

class SolidIdentityTest : public SimulationTest {
 protected:
  // Of a host that is in time on any number of boards.
  static std::vector<std::string> with(const std::vector<std::string>& set) {
    std::vector<std::string> all{"video.columns=144", "video.lines=112", "host.sustained_mflops=50.0"};
    all.insert(all.end(), set.begin(), set.end());
    return all;
  }
  std::string scene(std::uint32_t seed = 61) const {
    return written("scene.toml", SolidScene(seed, View::perspective).text());
  }
  Simulated shown(const std::vector<std::string>& set, std::uint64_t frames = 3, bool everything = false) const {
    return simulate(kQuadricMachine, scene(),
                    {.set = with(set), .frames = frames, .model_everything = everything, .reference = false});
  }
  static void expect_same_pictures(const Simulated& a, const Simulated& b) {
    ASSERT_EQ(a.shown.size(), b.shown.size());
    for (std::size_t k = 0; k < a.shown.size(); ++k) EXPECT_TRUE(same_picture(a.shown[k], b.shown[k])) << "frame " << k;
  }
  // The test is of something: solids and triangles are seen in every frame.
  static void expect_both_seen(const Simulated& simulated) {
    for (const frame::Frame& frame : simulated.shown) {
      std::size_t triangles = 0, solids = 0;
      for (const std::uint32_t object : frame.object) {
        triangles += object > 0 && object <= SolidScene::kTriangles ? 1 : 0;
        solids += object > SolidScene::kTriangles ? 1 : 0;
      }
      EXPECT_GT(triangles, 100U);
      EXPECT_GT(solids, 1000U);
    }
  }
};

TEST_F(SolidIdentityTest, ModelEverythingChangesNothingButWhatWasModelled) {
  Simulated lean = shown({});
  Simulated all = shown({}, 3, true);
  expect_both_seen(lean);
  expect_same_pictures(lean, all);
  EXPECT_EQ(lean.result.modelled.quadrics_used, SolidScene::kSolids);
  EXPECT_LE(lean.result.modelled.quadrics_instantiated, SolidScene::kSolids);
  EXPECT_EQ(lean.result.modelled.quadrics_available, 8U * 64);
  EXPECT_EQ(all.result.modelled.quadrics_instantiated, 8U * 64);
  EXPECT_LT(lean.result.modelled.lines_evaluated, lean.result.modelled.lines_total);
  EXPECT_EQ(all.result.modelled.lines_evaluated, all.result.modelled.lines_total);
  EXPECT_EQ(lean.result.modelled.fragments_in, all.result.modelled.fragments_in);
  EXPECT_EQ(lean.result.modelled.coefficients_sent, all.result.modelled.coefficients_sent);
  lean.result.modelled = all.result.modelled = {};
  EXPECT_EQ(report::json_text({lean.result, false}), report::json_text({all.result, false}));
}

TEST_F(SolidIdentityTest, PipelineAndTreeShowTheSame) {
  const Simulated tree = shown({});
  const Simulated pipeline = shown({"decision_unit.topology=pipeline"});
  expect_same_pictures(tree, pipeline);
  EXPECT_EQ(tree.result.modelled.fragments_kept, pipeline.result.modelled.fragments_kept);
  EXPECT_EQ(tree.result.modelled.fragments_in, pipeline.result.modelled.fragments_in);
  // 8 x (128 + 64) processors: 11 levels, or a comparator each.
  EXPECT_EQ(pipeline.result.frames[0].first_pixel_ps - tree.result.frames[0].first_pixel_ps, (1536U - 11) * 60'000);
}

// No two things of the scene have the same depth at a pixel.
TEST_F(SolidIdentityTest, NumberOfBoardsAndAssignmentChangeNoPicture) {
  const Simulated eight = shown({});
  for (const std::vector<std::string>& set : std::vector<std::vector<std::string>>{
           {"host.assignment=block"},
           {"host.computation_units=1", "quadric_processor.per_unit=10"},
           {"host.computation_units=3", "quadric_processor.per_unit=4"},
           {"host.computation_units=3", "quadric_processor.per_unit=4", "host.assignment=block",
            "decision_unit.topology=pipeline", "host.link_topology=chain"}}) {
    SCOPED_TRACE(set.back());
    const Simulated other = shown(set);
    expect_same_pictures(eight, other);
    EXPECT_EQ(eight.result.modelled.coefficients_sent, other.result.modelled.coefficients_sent);
  }
}

// Spheres that are one and the same: the one of the lowest board and slot is seen.
TEST_F(SolidIdentityTest, OfEqualDepthsTheLowestProcessorIsSeen) {
  std::string objects;
  for (int i = 0; i < 5; ++i) objects += "[[object]]\ntype = \"sphere\"\nmaterial = \"glaze\"\nradius = 1.5\n";
  const std::string file = written("equal.toml", scene_of(objects));
  for (const char* assignment : {"round_robin", "block"}) {
    const Simulated simulated = simulate(kQuadricMachine, file,
                                         {.set = with({"host.computation_units=2", "quadric_processor.per_unit=3",
                                                       std::string("host.assignment=") + assignment}),
                                          .reference = false});
    std::map<std::uint32_t, std::size_t> seen;
    for (std::size_t i = 0; i < simulated.shown[0].pixels(); ++i) {
      ++seen[simulated.shown[0].object[i]];
      EXPECT_EQ(simulated.shown[0].coverage[i], simulated.shown[0].object[i] == 0 ? 0U : 5U);
    }
    EXPECT_EQ(seen.size(), 2U);
    EXPECT_GT(seen[1], 1000U);  // board 0, slot 0
  }
}

// A triangle in the plane that halves a ball, parallel to the screen: the words of both are the same, and it is seen.
TEST_F(SolidIdentityTest, OfEqualDepthsATriangleIsSeen) {
  const std::string file = written("halved.toml", scene_of(R"([[object]]
type = "sphere"
material = "glaze"
radius = 2.0
[[object.plane]]
normal = [0.0, -1.0, 0.0]
distance = 0.0
[[object]]
type = "triangles"
material = "slate"
two_sided = true
positions = [[-1.0, 0.0, -0.8], [1.0, 0.0, -0.8], [0.0, 0.0, 1.2]]
)"));
  const Simulated simulated = simulate(kQuadricMachine, file, {.set = with({}), .reference = false});
  const frame::Frame& frame = simulated.shown[0];
  std::uint32_t depth = 0;
  std::size_t both = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (frame.object[i] == 0) continue;
    if (depth == 0) depth = frame.depth[i];
    EXPECT_EQ(frame.depth[i], depth);
    EXPECT_EQ(frame.object[i], frame.coverage[i]) << "the ball is 1, the triangle 2";
    both += frame.object[i] == 2 ? 1 : 0;
  }
  EXPECT_GT(both, 500U);
}

TEST_F(SolidIdentityTest, InterlacedVideoWeavesThePicturesOfTwoPoses) {
  const Simulated woven = shown({"video.interlaced=true"}, 2);
  const Simulated all = shown({"video.interlaced=true"}, 2, true);
  const Simulated fields = shown({}, 4);
  expect_same_pictures(woven, all);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t line = 0; line < kLines; ++line) {
      const frame::Frame& field = fields.shown[2 * k + line % 2];
      const frame::Frame& frame = woven.shown[k];
      const auto same = [&](const auto& a, const auto& b, std::size_t values) {
        const auto from = static_cast<std::ptrdiff_t>(line * kColumns * values);
        const auto to = from + static_cast<std::ptrdiff_t>(kColumns * values);
        return std::equal(a.begin() + from, a.begin() + to, b.begin() + from);
      };
      EXPECT_TRUE(same(frame.rgb, field.rgb, 3) && same(frame.depth, field.depth, 1) &&
                  same(frame.normal, field.normal, 3) && same(frame.object, field.object, 1) &&
                  same(frame.coverage, field.coverage, 1))
          << "frame " << k << " line " << line;
    }
}

// A root of 10 + 6 bits, a stage each, ten of a clock and six of two; the shifter, four slices of depth, a clock of
// comparisons; and the choice. In slices of 40 bits, a clock for each of these.
TEST_F(SolidIdentityTest, AlignmentMovesTheLatencyAndNoPixel) {
  const Simulated early = shown({});
  for (const auto& [set, latency] : std::vector<std::pair<std::vector<std::string>, std::uint64_t>>{
           {{}, 10 + 6 * 2 + 1 + 4 + 1 + 1},
           {{"quadric_processor.output_cycles=7"}, 10 + 6 * 2 + 1 + 4 + 1 + 7},
           {{"quadric_processor.slice_bits=40"}, 16 + 1 + 1 + 1 + 1}}) {
    std::vector<std::string> delayed = set;
    delayed.emplace_back("quadric_processor.alignment=delay");
    const Simulated delay = shown(delayed);
    expect_same_pictures(early, delay);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(delay.result.frames[k].first_pixel_ps, early.result.frames[k].first_pixel_ps + latency * 60'000);
      EXPECT_EQ(delay.result.frames[k].last_pixel_ps, early.result.frames[k].last_pixel_ps + latency * 60'000);
    }
    // A link word of 24 + 3 x 12 + 4 bits for each clock and board.
    const run::Memory& memory = named(delay.result.memories, "delay of triangles' fragments");
    EXPECT_EQ(memory.total_bits(), 8 * latency * 64);
    EXPECT_EQ(delay.result.memories.size(), early.result.memories.size() + 1);
  }
}

// Objects that find no processor are left out: what is shown is the scene without them.
TEST_F(SolidIdentityTest, SolidsWithoutProcessorsAreLeftOut) {
  const std::string all = written("all.toml", SolidScene(62, View::perspective).text());
  const std::string six = written("six.toml", SolidScene(62, View::perspective).text({0, 1, 2, 3, 4, 5}));
  const std::vector<std::string> few =
      with({"host.computation_units=3", "quadric_processor.per_unit=2", "host.overflow=drop"});
  const Simulated dropped = simulate(kQuadricMachine, all, {.set = few, .frames = 2, .reference = false});
  const Simulated wanted = simulate(kQuadricMachine, six, {.set = few, .frames = 2, .reference = false});
  expect_same_pictures(dropped, wanted);
  EXPECT_EQ(dropped.result.modelled.solids_dropped, 4U);
  EXPECT_EQ(dropped.result.modelled.solids_made, 10U);
  EXPECT_EQ(dropped.result.modelled.quadrics_used, 6U);
  const run::Budget& budget = named(dropped.result.budgets, "quadrics");
  EXPECT_DOUBLE_EQ(budget.used, 10);
  EXPECT_DOUBLE_EQ(budget.available, 6);
  EXPECT_FALSE(budget.fits);
  EXPECT_FALSE(dropped.result.answer.sustained);
  EXPECT_EQ(dropped.result.answer.bottleneck.unit, "quadric boards");
  EXPECT_THROW(simulate(kQuadricMachine, all,
                        {.set = with({"host.computation_units=3", "quadric_processor.per_unit=2"}), .frames = 1}),
               InputError);
}

// Solids with more planes than a processor has are refused: the picture is that of the others.
TEST_F(SolidIdentityTest, RefusedSolidsAreLeftOut) {
  const std::string all = written("all.toml", SolidScene(63, View::perspective).text());
  for (int caps : {0, 1, 2, 4, 5}) {
    SCOPED_TRACE(caps);
    std::set<int> left;
    for (int i = 0; i < SolidScene::kSolids; ++i)
      if (SolidScene::kPlanes[static_cast<std::size_t>(i)] <= caps) left.insert(i);
    const std::string some = written("some.toml", SolidScene(63, View::perspective).text(left));
    const std::vector<std::string> set =
        with({"quadric_processor.caps=" + std::to_string(caps), "quadric_processor.on_refusal=drop"});
    const Simulated refused = simulate(kQuadricMachine, all, {.set = set, .frames = 2, .reference = false});
    const Simulated wanted = simulate(kQuadricMachine, some, {.set = set, .frames = 2, .reference = false});
    // Their numbers among all objects.
    std::vector<std::uint32_t> numbers{0};
    for (std::uint32_t i = 1; i <= SolidScene::kTriangles; ++i) numbers.push_back(i);
    for (const int i : left) numbers.push_back(static_cast<std::uint32_t>(SolidScene::kTriangles + i + 1));
    for (std::size_t k = 0; k < 2; ++k) {
      frame::Frame renumbered = wanted.shown[k];
      for (std::uint32_t& object : renumbered.object) object = numbers.at(object);
      EXPECT_TRUE(same_picture(refused.shown[k], renumbered)) << "frame " << k;
      EXPECT_EQ(refused.result.frames[k].solids_refused, SolidScene::kSolids - left.size());
      EXPECT_EQ(refused.result.frames[k].solids_drawn, left.size());
    }
  }
}

// Neither triangles nor solids need the others: a scene of triangles on this machine is that on one without quadric
// processors, and none of these is simulated.
TEST_F(SolidIdentityTest, AMachineWithoutWorkForThemSimulatesNone) {
  const std::string file = written("triangles.toml", scene_of(std::string(kSphere) + kSpin));
  const std::vector<std::string> set = with({});
  const Simulated without = simulate(kMachine, file, {.set = set, .frames = 2, .reference = false});
  const Simulated with_them = simulate(kQuadricMachine, file, {.set = set, .frames = 2, .reference = false});
  expect_same_pictures(without, with_them);
  EXPECT_EQ(with_them.result.modelled.quadrics_instantiated, 0U);
  EXPECT_EQ(with_them.result.modelled.quadrics_used, 0U);
  EXPECT_EQ(with_them.result.modelled.quadrics_available, 512U);
  EXPECT_EQ(with_them.result.modelled.lines_evaluated, without.result.modelled.lines_evaluated);
  EXPECT_EQ(with_them.result.modelled.coefficients_sent, without.result.modelled.coefficients_sent);
  EXPECT_EQ(with_them.result.frames[0].host_flops, without.result.frames[0].host_flops);
}

class SolidProgramTest : public ProgramTest {};

TEST_F(SolidProgramTest, VectorVariantsGiveTheSameDirectory) {
  write("scene.toml", SolidScene(64, View::near_cuts).text());
  std::map<std::string, std::map<std::string, std::string>> files;
  for (const VectorVariant each : available_vector_variants()) {
    const char* const variant = name_of(each);
    ASSERT_EQ(::setenv("RASTERTLM_VECTOR", variant, 1), 0);
    const Outcome outcome = run({"render", kQuadricMachine, "scene.toml", "--out", variant, "--frames", "2", "--set",
                                 "video.columns=144", "--set", "video.lines=112"});
    ::unsetenv("RASTERTLM_VECTOR");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    for (const std::string& name : names(variant))
      files[variant][name] = file_text(in_work(std::string(variant) + "/" + name));
    ASSERT_GE(files[variant].size(), 8U);
    ASSERT_EQ(files[variant].size(), files["baseline"].size());
    for (const auto& [name, bytes] : files[variant])
      EXPECT_TRUE(bytes == files["baseline"][name]) << variant << ": " << name << " differs";
  }
}

}  // namespace
}  // namespace rastertlm::test
