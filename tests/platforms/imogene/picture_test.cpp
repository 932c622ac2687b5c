// The whole machine's pictures against the exact ones: what each pixel shows is exact given the snapped vertices
// (numerics of the edge equations), and how it is shaded is as far off as the end-to-end table of the shading chain.
#include <algorithm>
#include <numeric>

#include "tests/platforms/imogene/scenes.h"
#include "tests/platforms/imogene/simulation.h"

namespace rastertlm::test {
namespace {

// Exponent 20, ambient .1, diffuse .5, specular .4: the table's largest difference is 3 levels; other normals and
// lights than its draw are allowed 2 more.
constexpr int kLargestLevel = 5;

using PictureTest = SimulationTest;

// 28 patches of 4 x 4 quads of two triangles; at the pole of the lid one side of 16 of them has no length.
TEST_F(PictureTest, ShowsTheTeapotOnTheDefaultMachine) {
  constexpr std::uint64_t kMade = 28ULL * 4 * 4 * 2;
  constexpr std::uint64_t kAtThePole = 16;
  const Simulated simulated = simulate(kMachine, kTeapot, {});
  ASSERT_EQ(simulated.result.frames.size(), 1U);
  const run::FrameFigures& frame = simulated.result.frames[0];
  EXPECT_EQ(simulated.result.modelled.objects_made, kMade);
  EXPECT_EQ(simulated.result.modelled.objects_degenerate, kAtThePole);
  EXPECT_EQ(frame.drawn, kMade - kAtThePole);
  EXPECT_EQ(frame.degenerate, kAtThePole);
  EXPECT_EQ(frame.facing + frame.back_faces, kMade - kAtThePole);
  EXPECT_EQ(frame.outside, 0U);
  EXPECT_EQ(simulated.result.modelled.processors_available, 1024U);
  EXPECT_EQ(simulated.result.modelled.processors_used, kMade);
  expect_exact(simulated, kLargestLevel);
  EXPECT_GT(frame.covered_pixels, 40'000U);
}

// The figures of a frame are those of its pixels.
TEST_F(PictureTest, CountsThePixelsThatItShows) {
  const Simulated simulated = simulate(kMachine, kTeapot, {.set = {"video.columns=200", "video.lines=150"}});
  const frame::Frame& frame = simulated.shown.at(0);
  ASSERT_EQ(frame.columns, 200U);
  ASSERT_EQ(frame.lines, 150U);
  std::uint64_t covered = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    EXPECT_EQ(frame.object[i] != 0, frame.coverage[i] != 0);
    EXPECT_EQ(frame.object[i] != 0, frame.depth[i] != 0xffffff);
    covered += frame.object[i] != 0 ? 1U : 0U;
  }
  EXPECT_EQ(simulated.result.frames[0].covered_pixels, covered);
  EXPECT_EQ(simulated.result.frames[0].fragments,
            std::accumulate(frame.coverage.begin(), frame.coverage.end(), std::uint64_t{0}));
  EXPECT_EQ(simulated.result.modelled.fragments_kept, covered);
}

// Scenes of spheres are compared with the spheres too: of a solid that is the picture itself, of a mesh what the mesh
// lacks as well. Pixels that both show are of the same thing.
TEST_F(PictureTest, ComparesSpheresWithSpheres) {
  const std::string solid = "[[object]]\ntype = \"sphere\"\nmaterial = \"glaze\"\nradius = 2.0\n";
  for (const bool interlaced : {false, true}) {
    RunOptions options{.set = {"video.columns=200", "video.lines=150", "quadric_processor.per_unit=1",
                               interlaced ? "video.interlaced=true" : "video.interlaced=false"}};
    const Simulated exact = show(scene_of(solid), options), mesh = show(scene_of(kSphere), options);
    const reference::ErrorFigures of_solid = error_of(exact.result.frames[0], "sphere");
    const reference::ErrorFigures of_mesh = error_of(mesh.result.frames[0], "sphere");
    EXPECT_EQ(of_solid.covered_missing + of_solid.covered_extra, 0U);
    EXPECT_GT(of_solid.compared, 8'000U);
    EXPECT_GT(of_mesh.covered_missing, 50U);
    EXPECT_EQ(of_mesh.compared + of_mesh.covered_missing, of_solid.compared);
    EXPECT_EQ(of_mesh.wrong_object, 0U);
    EXPECT_EQ(error_of(mesh.result.frames[0], "snapped").covered_missing, 0U);
    EXPECT_NEAR(of_solid.rmse_level, error_of(exact.result.frames[0], "true").rmse_level, 1e-4);
  }
  const Simulated other = show(scene_of(std::string(kSphere) + "scale = [1.0, 1.0, 1.1]\n"), {});
  EXPECT_THROW(error_of(other.result.frames[0], "sphere"), std::runtime_error);
}

// Package glmark2-data. The file is in a cube from -1 to 1.
TEST_F(PictureTest, ShowsAMeshFileOnAMachineLargeEnough) {
  constexpr std::uint64_t kFaces = 69'666;  // lines of the file that begin with f, all triangles
  const std::string bunny = scene_of(R"([[object]]
type = "mesh"
material = "glaze"
file = "/usr/share/glmark2/models/bunny.obj"
)",
                                     R"([camera]
eye = [0.0, 0.0, 6.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
)");
  const Simulated simulated =
      show(bunny, {.set = {"host.computation_units=70", "host.processors_per_unit=1024"}, .pictures = false});
  EXPECT_EQ(simulated.result.modelled.objects_made, kFaces);
  EXPECT_EQ(simulated.result.modelled.processors_used, kFaces);
  const run::FrameFigures& frame = simulated.result.frames.at(0);
  EXPECT_EQ(frame.drawn + frame.degenerate, kFaces);
  EXPECT_GT(frame.covered_pixels, 60'000U);
  expect_exact(simulated, kLargestLevel);
}

// Handle and spout pierce the body: along these curves two surfaces are nearer to each other than a depth plane's error
// of a few units, and a pixel may show the other one.
TEST_F(PictureTest, ShowsAnAnimationOfTwentyFiveFrames) {
  constexpr std::uint64_t kOnThePiercingCurves = 2;
  constexpr std::uint64_t kFrames = 25;
  const Simulated simulated =
      simulate(kMachine, kTeapot, {.set = {"video.columns=256", "video.lines=256"}, .frames = kFrames});
  ASSERT_EQ(simulated.result.frames.size(), kFrames);
  expect_exact(simulated, kLargestLevel, kOnThePiercingCurves);
  for (std::size_t k = 0; k < kFrames; ++k) {
    EXPECT_EQ(simulated.result.frames[k].frame, k);
    EXPECT_EQ(simulated.result.frames[k].animation_frame, static_cast<std::int64_t>(k));
    // Besides the 16 of the lid's pole, small ones lose their area to the snapping.
    EXPECT_EQ(simulated.result.frames[k].drawn + simulated.result.frames[k].degenerate, 896U);
    EXPECT_GE(simulated.result.frames[k].degenerate, 16U);
    if (k > 0) {
      EXPECT_NE(simulated.shown[k].rgb, simulated.shown[k - 1].rgb) << "frame " << k;
    }
  }
}

// Frame n of the animation is the teapot turned by n times its angle: as a still scene it is the same picture.
TEST_F(PictureTest, ShowsInFrameNWhatAStillSceneTurnedByItShows) {
  const std::string teapot = "[[object]]\ntype = \"teapot\"\n";
  const std::vector<std::string> small{"video.columns=128", "video.lines=128"};
  const std::string camera = "[camera]\neye = [0.0, -14.0, 5.0]\ntarget = [0.0, 0.0, 1.5]\n";
  const Simulated moving =
      show(scene_of(teapot + "[[object.animation]]\ntype = \"spin\"\naxis = [0.0, 0.0, 1.0]\ndeg_per_frame = 45.0\n",
                    camera),
           {.set = small, .frames = 3});
  const Simulated still = show(scene_of(teapot + "rotate_deg = [0.0, 0.0, 90.0]\n", camera), {.set = small});
  EXPECT_TRUE(same_picture(moving.shown.at(2), still.shown.at(0)));
  EXPECT_FALSE(same_picture(moving.shown.at(0), still.shown.at(0)));
}

TEST_F(PictureTest, ShowsOnlyTheBackgroundWhereNothingIsInView) {
  const Simulated simulated = show("background = [10.0, 20.0, 30.0]\n" +
                                       scene_of("[[object]]\ntype = \"uv_sphere\"\ntranslate = [100.0, 0.0, 0.0]\n"),
                                   {.set = {"video.columns=32", "video.lines=32"}});
  const frame::Frame& frame = simulated.shown.at(0);
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    EXPECT_EQ(frame.rgb[3 * i], 10);
    EXPECT_EQ(frame.rgb[3 * i + 1], 20);
    EXPECT_EQ(frame.rgb[3 * i + 2], 30);
    EXPECT_EQ(frame.depth[i], 0xffffffU);
    EXPECT_EQ(frame.coverage[i], 0U);
  }
  EXPECT_EQ(simulated.result.warnings.size(), 1U);
}

}  // namespace
}  // namespace rastertlm::test
