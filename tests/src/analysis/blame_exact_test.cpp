// Which triangle is seen by whose edges and whose depth, and who is to blame for another one? And is the exact side the
// ideal picture's?
#include "src/analysis/blame_exact.h"

#include <gtest/gtest.h>

#include "src/run/exact_pictures.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {
namespace {

StepSet exact(std::initializer_list<Step> steps) {
  StepSet set;
  for (const Step step : steps) set = set.with(step);
  return set;
}

// Triangle 1 lies before triangle 2, and both cover the pixel, but the machine's edges of 1 leave it out.
TEST(BlameExact, AnEdgeThatLeavesThePixelOut) {
  const Cover first{1, 10.0, 10.0}, second{2, 20.0, 20.0};
  const Cover both[]{first, second};
  const Seen seen = seen_by(2, 1, both, std::span(&second, 1));
  EXPECT_EQ(seen.to_blame(), Step::coverage);
  EXPECT_EQ(seen.object(exact({})), 2U);
  EXPECT_EQ(seen.object(exact({Step::coverage})), 1U);
  EXPECT_EQ(seen.object(exact({Step::depth_order})), 2U);
  EXPECT_EQ(seen.object(exact({Step::coverage, Step::depth_order})), 1U);
}

TEST(BlameExact, ATriangleThatCoversTooMuch) {
  const Cover first{1, 10.0, 10.0};
  const Seen seen = seen_by(1, 0, {}, std::span(&first, 1));
  EXPECT_EQ(seen.to_blame(), Step::coverage);
  EXPECT_EQ(seen.object(exact({Step::coverage})), 0U);
}

// Words that round 1 behind 2; where they are equal, the lower number is seen.
TEST(BlameExact, DepthThatIsRounded) {
  const Cover covers[]{{1, 10.2, 11.0}, {2, 10.4, 10.0}};
  const Seen seen = seen_by(2, 1, covers, covers);
  EXPECT_EQ(seen.to_blame(), Step::depth_order);
  EXPECT_EQ(seen.object(exact({Step::coverage})), 2U);
  EXPECT_EQ(seen.object(exact({Step::depth_order})), 1U);
  const Cover equal[]{{1, 10.4, 10.0}, {2, 10.2, 10.0}};
  EXPECT_EQ(seen_by(1, 2, equal, equal).to_blame(), Step::depth_order);
}

TEST(BlameExact, TheSameTriangleIsNobodysFault) { EXPECT_EQ((Seen{3, 3, 3, 3}).to_blame(), Step::none); }

// Of every pixel of the teapot: the nearest of the pieces that cover it is what the ideal picture shows.
TEST(BlameExact, CoversWhatTheIdealPictureShows) {
  const std::string configs = std::string(RASTERTLM_SOURCE_DIR) + "/configs/";
  const run::Inputs inputs = run::read_inputs(configs + "machines/imogene.toml", configs + "scenes/teapot.toml",
                                              {"video.columns=96", "video.lines=64"});
  const auto& machine = std::get<imogene::Machine>(inputs.content->machine);
  const scene::Scene& scene = *inputs.content->scene;
  const scene::Pose pose = scene::pose(scene, 3, 96, 64);
  const reference::RenderOptions options = run::exact_options(machine).front();
  const frame::ExactFrame picture = reference::render(scene, pose, options);
  const ExactSide side(scene, pose, options);
  std::size_t seen = 0;
  for (std::size_t y = 0; y < 64; ++y)
    for (std::size_t x = 0; x < 96; ++x) {
      std::uint32_t nearest = 0;
      double depth = 2.0;
      for (const ExactPiece& piece : side.pieces())
        if (ExactSide::covers(piece, x, y) && ExactSide::depth(piece, x, y) < depth) {
          nearest = piece.piece.object;
          depth = ExactSide::depth(piece, x, y);
        }
      EXPECT_EQ(nearest, picture.object[y * 96 + x]) << x << ", " << y;
      seen += nearest != 0 ? 1 : 0;
      if (nearest == 0) continue;
      const ExactPiece* piece = side.piece_of(nearest, x, y);
      EXPECT_EQ(ExactSide::depth(*piece, x, y), picture.depth[y * 96 + x]);
      EXPECT_EQ(side.light().levels(piece->piece, ExactSide::weights(*piece, x, y)).x, picture.rgb[3 * (y * 96 + x)]);
    }
  EXPECT_GT(seen, 500U);
}

}  // namespace
}  // namespace rastertlm::analysis
