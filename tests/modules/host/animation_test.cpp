// Is a frame's message as large as what moved, and is what must be computed again exactly what can have changed?
#include "modules/host/animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastertlm::host {
namespace {

using testing::ElementsAre;

// Bytes: header 8, a matrix 64, a light's direction 12; with the camera come its two matrices and the lights.
constexpr std::uint64_t kHeader = 8;
constexpr std::uint64_t kMatrix = 64;
constexpr std::uint64_t kLight = 12;

ResidentScene scene(const std::vector<bool>& moves, bool camera_moves, std::size_t lights) {
  ResidentScene resident;
  for (const bool moving : moves) resident.objects.push_back({nullptr, false, moving});
  resident.camera_moves = camera_moves;
  resident.pose = [lights, objects = moves.size()](std::int64_t frame) {
    geometry::Pose pose;
    pose.world_to_eye[3][0] = static_cast<double>(frame);
    pose.object_to_eye.resize(objects, glm::dmat4(1.0));
    pose.normal_to_eye.resize(objects, glm::dmat3(1.0));
    pose.lights.resize(lights);
    return pose;
  };
  return resident;
}

TEST(Animation, TheFirstFrameBringsEverything) {
  const ResidentScene resident = scene({false, true, false}, false, 2);
  const FrameWork work = Animation(resident, false).frame_work(0, true);
  EXPECT_TRUE(work.initial);
  EXPECT_TRUE(work.lights_changed);
  EXPECT_THAT(work.renew, ElementsAre(1, 1, 1));
  EXPECT_EQ(work.message_bytes, kHeader + 2 * kMatrix + 2 * kLight + 3 * kMatrix);
}

TEST(Animation, AMovingObjectIsAMatrix) {
  const ResidentScene resident = scene({false, true, false, true}, false, 1);
  const Animation animation(resident, false);
  const FrameWork work = animation.frame_work(7, false);
  EXPECT_EQ(work.animation_frame, 7);
  EXPECT_EQ(work.pose.world_to_eye[3][0], 7.0);
  EXPECT_FALSE(work.initial);
  EXPECT_FALSE(work.lights_changed);
  EXPECT_THAT(work.renew, ElementsAre(0, 1, 0, 1));
  EXPECT_EQ(work.message_bytes, kHeader + 2 * kMatrix);
  EXPECT_TRUE(animation.moves());
}

// The camera moves every object and every light against the eye, but its matrices and the lights are all that is sent.
TEST(Animation, AMovingCameraRenewsEverything) {
  const ResidentScene resident = scene({false, true}, true, 3);
  const Animation animation(resident, false);
  const FrameWork work = animation.frame_work(1, false);
  EXPECT_TRUE(work.lights_changed);
  EXPECT_THAT(work.renew, ElementsAre(1, 1));
  EXPECT_EQ(work.message_bytes, kHeader + 2 * kMatrix + 3 * kLight + kMatrix);
  EXPECT_TRUE(animation.moves());
}

TEST(Animation, AStillSceneSendsNothing) {
  const ResidentScene resident = scene({false, false}, false, 1);
  const Animation animation(resident, false);
  const FrameWork work = animation.frame_work(1, false);
  EXPECT_FALSE(work.lights_changed);
  EXPECT_THAT(work.renew, ElementsAre(0, 0));
  EXPECT_EQ(work.message_bytes, kHeader);
  EXPECT_FALSE(animation.moves());
}

// host.send = "all": coefficients again; the matrices that did not change are still not sent.
TEST(Animation, SendAllRenewsWhatDidNotChange) {
  const ResidentScene resident = scene({false, true}, false, 1);
  const Animation animation(resident, true);
  const FrameWork work = animation.frame_work(1, false);
  EXPECT_THAT(work.renew, ElementsAre(1, 1));
  EXPECT_EQ(work.message_bytes, kHeader + kMatrix);
  const ResidentScene still = scene({false}, false, 1);
  EXPECT_TRUE(Animation(still, true).moves());
  EXPECT_THAT(Animation(still, true).frame_work(1, false).renew, ElementsAre(1));
}

}  // namespace
}  // namespace rastertlm::host
