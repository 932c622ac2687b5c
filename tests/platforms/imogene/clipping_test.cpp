// What leaves the screen, the near or the far plane is clipped to the guard band, and its pieces take free object
// processors: the picture stays exact given the snapped vertices.
#include <algorithm>
#include <array>
#include <numeric>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

// 256 x 256, where words of 24 bits leave 7 fraction bits to vertices on the screen (255^2 x 2^7 < 2^23) and 5 in the
// guarded box of just under twice the screen (510^2 x 2^5 < 2^23).
const std::vector<std::string> kSmall{"video.columns=256", "video.lines=256"};
constexpr int kFine = 7;
constexpr int kGuarded = 5;

std::vector<std::string> with(std::vector<std::string> set, const std::vector<std::string>& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

std::string sphere_at(const std::string& where, const std::string& more = "") {
  return std::string(kSphere) + "translate = " + where + '\n' + more;
}

constexpr std::uint64_t kSphereTriangles = 2ULL * 24 * (16 - 1);
constexpr int kLargestLevel = 5;        // as a whole picture's
constexpr int kLargestOfTwoLights = 8;  // each light's tables round on their own

struct Case {
  const char* name;
  std::string scene;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> clipped_scenes() {
  const std::string camera = "[camera]\neye = [0.0, -10.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\n";
  const std::string orthographic = camera + "projection = \"orthographic\"\n";
  const std::string two_sided = "two_sided = true\n";
  return {
      {"LeftAndTop", scene_of(sphere_at("[-2.5, 0.0, 1.5]"))},
      {"RightAndBottom", scene_of(sphere_at("[2.0, 0.0, -2.5]"))},
      {"LargerThanTheScreen", scene_of(sphere_at("[0.0, -5.0, 0.3]"))},
      {"NearPlane", scene_of(sphere_at("[0.1, 0.0, 0.2]", two_sided), camera + "near = 9.0\nfar = 20.0\n")},
      {"FarPlane", scene_of(sphere_at("[0.1, 0.0, 0.2]", two_sided), camera + "near = 1.0\nfar = 9.0\n")},
      {"BothPlanes", scene_of(sphere_at("[0.1, 0.0, 0.2]", two_sided), camera + "near = 9.0\nfar = 9.5\n")},
      {"EyeInside", scene_of(sphere_at("[0.0, -9.5, 0.3]", two_sided), camera + "near = 0.5\n")},
      {"OrthographicNearPlane",
       scene_of(sphere_at("[0.1, 0.0, 0.2]", two_sided), orthographic + "height = 5.0\nnear = 9.0\n")},
      {"OrthographicLarger", scene_of(sphere_at("[0.4, 0.0, 0.2]"), orthographic + "height = 3.0\n")},
      {"HugeTriangle", scene_of(R"([[object]]
type = "triangles"
two_sided = true
positions = [[-900.0, 4.0, -300.0], [1000.0, 3.0, -250.0], [30.0, 5.0, 800.0], [-0.5, 0.0, -0.5], [0.6, 0.0, -0.5], [0.0, 9000.0, 1.0]]
)")},
  };
}

class ClippedScene : public SimulationTest, public testing::WithParamInterface<Case> {};

TEST_P(ClippedScene, IsExact) {
  const Simulated simulated = show(GetParam().scene, {.set = kSmall});
  expect_exact(simulated, kLargestLevel);
  const run::FrameFigures& frame = simulated.result.frames.at(0);
  EXPECT_EQ(frame.snap_fraction_bits, kGuarded);
  EXPECT_GT(frame.covered_pixels, 500U);
  EXPECT_LT(frame.facing, simulated.result.modelled.objects_made + 1);
}

INSTANTIATE_TEST_SUITE_P(Imogene, ClippedScene, testing::ValuesIn(clipped_scenes()),
                         [](const auto& scene) { return std::string(scene.param.name); });

using ClippingTest = SimulationTest;

TEST_F(ClippingTest, KeepsTheFineGridWhereEverythingIsOnTheScreen) {
  const Simulated simulated = show(scene_of(sphere_at("[0.1, 0.0, 0.2]")), {.set = kSmall});
  EXPECT_EQ(simulated.result.frames.at(0).snap_fraction_bits, kFine);
  EXPECT_EQ(simulated.result.frames.at(0).pieces, 0U);
  expect_exact(simulated, kLargestLevel);
}

// Closed surfaces from outside: a front face that is kept too changes nothing that is seen.
TEST_F(ClippingTest, TwoSidedShowsTheInsideOfAnOpenSphere) {
  const std::string camera = "[camera]\neye = [0.0, -10.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\nnear = 10.0\n";
  const Simulated one = show(scene_of(sphere_at("[0.0, 0.0, 0.0]"), camera), {.set = kSmall});
  const Simulated two = show(scene_of(sphere_at("[0.0, 0.0, 0.0]", "two_sided = true\n"), camera), {.set = kSmall});
  EXPECT_EQ(one.result.frames.at(0).covered_pixels, 0U);  // the front half is cut away, the back half turned away
  EXPECT_GT(two.result.frames.at(0).covered_pixels, 10'000U);
  expect_exact(two, kLargestLevel);
}

TEST_F(ClippingTest, ShowsSeveralObjectsMaterialsAndLights) {
  const std::string scene = scene_of(std::string(R"([[object]]
type = "teapot"
material = "slate"
translate = [-1.5, 1.0, -1.0]
scale = [0.7, 0.7, 0.7]
[[object]]
type = "uv_sphere"
material = "glaze"
translate = [1.5, 0.0, 1.2]
radius = 1.6
[[object]]
type = "triangles"
material = "slate"
two_sided = true
positions = [[-3.0, 2.0, -2.0], [3.0, -1.0, -1.0], [0.5, 1.0, 3.5], [3.0, 3.0, 3.0], [-3.0, 0.0, 2.0], [-1.0, -2.0, -2.5]]
[[light]]
towards = [-0.8, -0.3, 0.5]
intensity = [0.3, 0.4, 0.5]
)"));
  const Simulated simulated = show(scene, {.set = with(kSmall, {"shading.lights=2", "host.processors_per_unit=160"})});
  expect_exact(simulated, kLargestOfTwoLights);
  const frame::Frame& frame = simulated.shown.at(0);
  std::array<std::uint64_t, 2> of_material{};
  for (std::size_t i = 0; i < frame.pixels(); ++i)
    if (frame.object[i] != 0) ++of_material.at(frame.material[i]);
  EXPECT_GT(of_material[0], 1000U);
  EXPECT_GT(of_material[1], 1000U);
  EXPECT_GT(*std::max_element(frame.coverage.begin(), frame.coverage.end()), 1U);
}

// A sphere that the near plane cuts, on machines with ever fewer free processors.
class PieceTest : public SimulationTest {
 protected:
  const std::string scene_ =
      scene_of(sphere_at("[0.1, 0.0, 0.2]", "two_sided = true\n"), std::string(kCamera) + "near = 9.1\n");
  // What clipping makes beyond one piece a triangle, where there is room for all.
  std::uint64_t pieces() const { return show(scene_, {.set = kSmall, .pictures = false}).result.frames.at(0).pieces; }
  std::vector<std::string> machine(std::uint64_t units, std::uint64_t processors, const char* assignment) const {
    return with(kSmall, {"host.computation_units=" + std::to_string(units),
                         "host.processors_per_unit=" + std::to_string(processors),
                         std::string("host.assignment=") + assignment});
  }
};

TEST_F(PieceTest, TakesFreeProcessorsOfTheSameBoard) {
  const Simulated simulated = show(scene_, {.set = kSmall});
  EXPECT_GT(simulated.result.frames.at(0).pieces, 5U);
  EXPECT_EQ(simulated.result.frames.at(0).pieces_dropped, 0U);
  expect_exact(simulated, kLargestLevel);
}

// Two full boards, and one with nothing but free processors.
TEST_F(PieceTest, TakesFreeProcessorsOfOtherBoards) {
  const Simulated near = show(scene_, {.set = kSmall});
  const Simulated far = show(scene_, {.set = machine(3, kSphereTriangles / 2, "block")});
  EXPECT_EQ(far.result.frames.at(0).pieces, near.result.frames.at(0).pieces);
  expect_exact(far, kLargestLevel);
  // Only who computes has changed.
  EXPECT_EQ(far.shown.at(0).rgb, near.shown.at(0).rgb);
  EXPECT_EQ(far.shown.at(0).object, near.shown.at(0).object);
}

// Exactly as many free processors as there are pieces.
TEST_F(PieceTest, TakesTheLastFreeProcessor) {
  const std::uint64_t needed = kSphereTriangles + pieces();
  const Simulated simulated = show(scene_, {.set = machine(1, needed, "block")});
  expect_exact(simulated, kLargestLevel);
  EXPECT_THROW(show(scene_, {.set = machine(1, needed - 1, "block")}), InputError);
}

TEST_F(PieceTest, RefusesWhereNoProcessorIsFreeAndSaysHowManyPieces) {
  try {
    show(scene_, {.set = machine(2, kSphereTriangles / 2, "round_robin")});
    FAIL() << "the machine has no free processor";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("animation frame 0"), std::string::npos) << text;
    EXPECT_NE(text.find("makes " + std::to_string(pieces()) + " more pieces"), std::string::npos) << text;
    EXPECT_NE(text.find("host.processors_per_unit"), std::string::npos) << text;
  }
}

// The far plane leaves a cap of the sphere; nothing is behind the pieces at its rim.
TEST_F(PieceTest, DropsAndCountsWhatFindsNoProcessor) {
  const std::string cap = scene_of(sphere_at("[0.1, 0.0, 0.2]"), std::string(kCamera) + "far = 9.1\n");
  const Simulated all = show(cap, {.set = kSmall});
  const Simulated simulated =
      show(cap, {.set = with(machine(2, kSphereTriangles / 2, "round_robin"), {"host.overflow=drop"})});
  const run::FrameFigures& frame = simulated.result.frames.at(0);
  EXPECT_EQ(frame.pieces_dropped, all.result.frames.at(0).pieces);
  EXPECT_EQ(frame.pieces, 0U);
  const reference::ErrorFigures& error = error_of(frame, "snapped");
  EXPECT_EQ(error.covered_missing, all.result.frames.at(0).covered_pixels - frame.covered_pixels);
  EXPECT_GT(error.covered_missing, 0U);
  EXPECT_EQ(error.covered_extra, 0U);
  EXPECT_EQ(error.wrong_object, 0U);
}

// Every frame turns the object once round: each drops as many pieces as the first, and the machine does not sustain
// that.
TEST_F(PieceTest, CountsDroppedPiecesAFrameAndSaysSo) {
  const std::string cap =
      scene_of(sphere_at("[0.1, 0.0, 0.2]", "[[object.animation]]\ntype = \"spin\"\ndeg_per_frame = 360.0\n"),
               std::string(kCamera) + "far = 9.1\n");
  const Simulated simulated =
      show(cap, {.set = with(machine(2, kSphereTriangles / 2, "round_robin"), {"host.overflow=drop"}), .frames = 4});
  const std::uint64_t first = simulated.result.frames.at(0).pieces_dropped;
  EXPECT_GT(first, 0U);
  for (const run::FrameFigures& frame : simulated.result.frames) EXPECT_EQ(frame.pieces_dropped, first);
  const run::Budget& processors = named(simulated.result.budgets, "processors");
  EXPECT_DOUBLE_EQ(processors.used, static_cast<double>(kSphereTriangles + first));
  EXPECT_FALSE(processors.fits);
  EXPECT_FALSE(simulated.result.answer.sustained);
  ASSERT_EQ(simulated.result.warnings.size(), 1U);
  EXPECT_NE(simulated.result.warnings[0].find(std::to_string(first) + " pieces"), std::string::npos);
}

TEST_F(PieceTest, RefusesMoreObjectsThanProcessorsWithBothNumbers) {
  try {
    show(scene_, {.set = machine(2, 300, "round_robin")});
    FAIL() << "720 objects on 600 processors";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("720"), std::string::npos) << text;
    EXPECT_NE(text.find("600"), std::string::npos) << text;
  }
}

TEST_F(PieceTest, DropsObjectsThatFindNoProcessor) {
  const std::string scene = scene_of(sphere_at("[0.0, 0.0, 0.0]", "rotate_deg = [70.0, 0.0, 0.0]\n"));
  const Simulated simulated = show(scene, {.set = with(machine(2, 300, "round_robin"), {"host.overflow=drop"})});
  EXPECT_EQ(simulated.result.modelled.objects_dropped, kSphereTriangles - 600);
  EXPECT_EQ(simulated.result.modelled.processors_used, 600U);
  const reference::ErrorFigures& error = error_of(simulated.result.frames.at(0), "snapped");
  EXPECT_EQ(error.covered_extra, 0U);
  for (const std::uint32_t object : simulated.shown.at(0).object) EXPECT_LE(object, 600U);
  EXPECT_EQ(simulated.result.warnings.size(), 1U);
}

class MotionTest : public SimulationTest {
 protected:
  static constexpr std::uint64_t kFrames = 6;
};

// It begins on the screen, leaves it at the right and comes back: the grid changes for all triangles, moving or not.
TEST_F(MotionTest, ChangesTheGridOfStillObjectsToo) {
  const std::string scene = scene_of(R"([[object]]
type = "uv_sphere"
material = "slate"
radius = 0.8
translate = [-0.7, 0.0, 0.0]
[[object]]
type = "uv_sphere"
material = "glaze"
radius = 0.9
[[object.animation]]
type = "keys"
[[object.animation.key]]
frame = 0
[[object.animation.key]]
frame = 3
translate = [3.0, 0.0, 0.0]
[[object.animation.key]]
frame = 5
translate = [0.0, 1.0, 0.5]
)");
  const Simulated simulated = show(scene, {.set = kSmall, .frames = kFrames});
  expect_exact(simulated, kLargestLevel);
  std::vector<int> grids;
  for (const run::FrameFigures& frame : simulated.result.frames) grids.push_back(frame.snap_fraction_bits);
  // At distance 10 (9.1 to its front) the border is 2.68 (2.44) from the middle: centre + 0.9 crosses it in frames 2 to
  // 4 (x = 2, 3, 1.5 with y 0.5 behind), in frame 4 2.4 of 2.7.
  EXPECT_EQ(grids, (std::vector<int>{kFine, kFine, kGuarded, kGuarded, kFine, kFine}));
}

// At first the near plane cuts it; then it is aside and farther away, and nothing may be left where its pieces were.
TEST_F(MotionTest, ParksTheProcessorsOfPiecesThatAreNoMore) {
  const std::string scene = scene_of(R"([[object]]
type = "uv_sphere"
two_sided = true
[[object.animation]]
type = "keys"
[[object.animation.key]]
frame = 0
translate = [-1.1, 0.0, 0.0]
[[object.animation.key]]
frame = 2
translate = [1.4, 2.0, 0.0]
)",
                                     std::string(kCamera) + "near = 9.3\n");
  const Simulated simulated = show(scene, {.set = kSmall, .frames = 3});
  EXPECT_GT(simulated.result.frames.at(0).pieces, 3U);
  EXPECT_EQ(simulated.result.frames.at(2).pieces, 0U);
  expect_exact(simulated, kLargestLevel);
  const frame::Frame& last = simulated.shown.at(2);
  for (std::size_t y = 0; y < last.lines; ++y)
    for (std::size_t x = 0; x < last.columns / 2; ++x) ASSERT_EQ(last.object[y * last.columns + x], 0U);
}

TEST_F(MotionTest, SendsOnlyWhatMoved) {
  const std::string still = R"([[object]]
type = "uv_sphere"
material = "slate"
radius = 1.0
translate = [-1.2, 0.0, 0.0]
)";
  const std::string moving = std::string(R"([[object]]
type = "uv_sphere"
material = "glaze"
radius = 1.2
translate = [1.2, 0.0, 0.0]
slices = 10
stacks = 6
)") + kSpin;
  constexpr std::uint64_t kWords = 22;  // 21 coefficients and a material
  const Simulated changed = show(scene_of(still + moving), {.set = kSmall, .frames = kFrames});
  const Simulated all = show(scene_of(still + moving), {.set = with(kSmall, {"host.send=all"}), .frames = kFrames});
  const Simulated alone = show(scene_of(moving), {.set = kSmall, .frames = kFrames});
  expect_exact(changed, kLargestLevel);
  for (std::size_t k = 0; k < kFrames; ++k) {
    EXPECT_TRUE(same_picture(changed.shown[k], all.shown[k])) << "frame " << k;
    const run::FrameFigures& frame = changed.result.frames[k];
    if (k > 0) {
      EXPECT_EQ(frame.words_sent, alone.result.frames[k].words_sent) << "frame " << k;
      EXPECT_EQ(all.result.frames[k].words_sent,
                frame.words_sent + kWords * (changed.result.frames[0].facing - alone.result.frames[0].facing));
    }
  }
}

// The camera turns about the world's axis: lights turn in eye space, tables reload, all coefficients are new.
TEST_F(MotionTest, ReloadsTablesAndCoefficientsWhereTheCameraMoves) {
  const std::string camera = std::string(kCamera) + R"([[camera.animation]]
type = "orbit"
axis = [0.0, 0.0, 1.0]
deg_per_frame = 25.0
)";
  const Simulated simulated = show(scene_of(sphere_at("[0.3, 0.0, 0.2]"), camera), {.set = kSmall, .frames = kFrames});
  expect_exact(simulated, kLargestLevel);
  // Six loads, those of the frames after the first and the one that is on its way at the end, of N.L and N.H tables for
  // x, y and z. The light's height in eye space stays, so that table of N.L stays too: both banks were filled before
  // the first picture.
  constexpr std::uint64_t kTables = kFrames * (2 * 3 - 1);
  constexpr std::uint64_t kTableBytes = 2048 * 11 / 8;
  EXPECT_EQ(named(simulated.result.links, "dot product loader to tables").bytes, kTables * kTableBytes);
  for (std::size_t k = 1; k < kFrames; ++k) EXPECT_NE(simulated.shown[k].rgb, simulated.shown[k - 1].rgb);
}

// The light comes from where the camera first stands, and stays there.
TEST_F(MotionTest, ShowsTheDarkSideAfterHalfATurnOfTheCamera) {
  const std::string scene = std::string(R"(schema = 1
[[light]]
towards = [0.0, -1.0, 0.0]
[[material]]
name = "chalk"
colour = [1.0, 1.0, 1.0]
ambient = 0.1
diffuse = 0.9
specular = 0.0
)") + kCamera + R"([[camera.animation]]
type = "orbit"
axis = [0.0, 0.0, 1.0]
deg_per_frame = 36.0
[[object]]
type = "uv_sphere"
radius = 2.0
slices = 24
stacks = 16
)";
  const Simulated simulated = show(scene, {.set = kSmall, .frames = kFrames});
  std::vector<std::uint64_t> light;
  for (const frame::Frame& frame : simulated.shown)
    light.push_back(std::accumulate(frame.rgb.begin(), frame.rgb.end(), std::uint64_t{0}));
  for (std::size_t k = 1; k < light.size(); ++k) EXPECT_LT(light[k], light[k - 1]) << "frame " << k;
  // The last frame, after half a turn, shows ambient light alone: round(25.5) where the sphere is.
  for (std::size_t i = 0; i < simulated.shown[5].pixels(); ++i) {
    EXPECT_EQ(simulated.shown[5].rgb[3 * i], simulated.shown[5].object[i] != 0 ? 26 : 0);
  }
}

}  // namespace
}  // namespace rastertlm::test
