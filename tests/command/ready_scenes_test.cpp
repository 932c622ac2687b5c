// The scenes of configs/scenes, each on a machine that is made for it, on a small screen: they run, and show what the
// exact picture shows.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "tests/support/run_program.h"

namespace rastertlm::test {
namespace {

struct ReadyScene {
  const char* name;
  const char* machine;
  const char* least_psnr_db;  // outlines included: a missing object costs more than ten
};

constexpr ReadyScene kScenes[] = {
    {"ellipsoid", "imogene_quadrics", "45"},
    {"lamp_at_sphere", "adaptive", "18"},
    {"molecule", "imogene_quadrics", "40"},
    {"robot_arm", "imogene_quadrics", "40"},
    {"solids", "imogene_quadrics", "45"},
    {"sphere_168", "quadratic", "30"},
    {"sphere_374", "quadratic", "30"},
    {"sphere_690", "quadratic", "30"},
    {"sphere_quadric", "imogene_quadrics", "45"},
    {"teapot", "imogene", "45"},
    {"teapot_60_views", "adaptive", "20"},
    {"teapot_at_rest", "adaptive", "20"},
    {"teapot_four_lights", "adaptive", "20"},
    {"teapot_orbit", "imogene", "45"},
};

class ReadySceneTest : public ProgramTest, public testing::WithParamInterface<ReadyScene> {};

TEST_P(ReadySceneTest, IsShownAsItIs) {
  const ReadyScene& given = GetParam();
  const std::string configs = RASTERTLM_SOURCE_DIR "/configs/";
  const Outcome outcome = run({"render", configs + "machines/" + given.machine + ".toml",
                               configs + "scenes/" + given.name + ".toml", "--frames", "2", "--set", "video.columns=96",
                               "--set", "video.lines=96", "--require-psnr", given.least_psnr_db, "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(All, ReadySceneTest, testing::ValuesIn(kScenes),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(ReadyScenes, AllAreTested) {
  std::set<std::string> tested, shipped;
  for (const ReadyScene& scene : kScenes) tested.insert(scene.name);
  for (const auto& entry : std::filesystem::directory_iterator(RASTERTLM_SOURCE_DIR "/configs/scenes"))
    if (entry.path().extension() == ".toml") shipped.insert(entry.path().stem().string());
  EXPECT_EQ(tested, shipped);
}

}  // namespace
}  // namespace rastertlm::test
