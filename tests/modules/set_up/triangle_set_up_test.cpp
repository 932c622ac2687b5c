// The whole set-up: what is drawn and what is not, the same words counted or not, and any finite input.
#include "modules/set_up/triangle_set_up.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "modules/set_up/pieces.h"
#include "src/geometry/counted.h"
#include "tests/modules/set_up/triangles.h"

namespace rastertlm::set_up::test {
namespace {

using Number = geometry::Counted<double>;

geometry::SnapGrids grids_of(const WordFormat& format) {
  return geometry::snap_grids(format.columns, format.lines, format.word_bits, -1).value();
}

// Counter-clockwise to the eye: y points down.
Triangle front_face() {
  Triangle t;
  t[0].x = 100.25, t[0].y = 300.5, t[0].z = 0.25, t[0].normal = {0.1, -0.2, 0.9};
  t[1].x = 300.75, t[1].y = 310.0, t[1].z = 0.5, t[1].normal = {-0.3, 0.2, 0.8};
  t[2].x = 180.0, t[2].y = 90.125, t[2].z = 0.75, t[2].normal = {0.2, 0.6, 0.7};
  return t;
}

ScreenTriangle<Number> counted(const Triangle& t) {
  ScreenTriangle<Number> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = {t[i].x, t[i].y, t[i].z, t[i].inverse_w, {t[i].normal.x, t[i].normal.y, t[i].normal.z}};
  return result;
}

TEST(TriangleSetUp, DropsBackFacesAndTurnsTwoSidedOnes) {
  const WordFormat format;
  const geometry::SnapGrid grid = grids_of(format).on_screen;
  const Triangle front = front_face();
  const Triangle back{front[1], front[0], front[2]};
  const SetUpResult shown = set_up_triangle(front, 3, false, grid, format);
  EXPECT_EQ(shown.outcome, Outcome::drawn);
  EXPECT_EQ(shown.words.material, 3U);

  const SetUpResult culled = set_up_triangle(back, 3, false, grid, format);
  EXPECT_EQ(culled.outcome, Outcome::back_face);
  const SetUpResult turned = set_up_triangle(back, 3, true, grid, format);
  ASSERT_EQ(turned.outcome, Outcome::drawn);
  EXPECT_EQ(set_up_triangle(front, 3, true, grid, format).words, shown.words);

  int covered = 0;
  for (std::uint64_t y = 0; y < 512; y += 3)
    for (std::uint64_t x = 0; x < 512; x += 3) {
      ASSERT_EQ(covers(shown.words, x, y, 24), covers(turned.words, x, y, 24));
      ASSERT_FALSE(covers(culled.words, x, y, 24));
      if (!covers(shown.words, x, y, 24)) continue;
      ++covered;
      // Both planes are rounded apart, each within 0.5 ((w + h) / 2 + 1) = 106.
      for (std::size_t i = 0; i < 3; ++i)
        ASSERT_LE(std::abs(sign_extend(word_at(shown.words.normals[i], x, y, 24), 24) +
                           sign_extend(word_at(turned.words.normals[i], x, y, 24), 24)),
                  2 * 106);
    }
  EXPECT_GT(covered, 1000);
}

TEST(TriangleSetUp, ParksWhatHasNoArea) {
  for (const EdgeForm edges : {EdgeForm::snapped, EdgeForm::scaled}) {
    const WordFormat format{24, 512, 512, edges};
    Triangle t = front_face();
    t[2] = t[1];
    SetUpResult result = set_up_triangle(t, 7, true, grids_of(format).on_screen, format);
    EXPECT_EQ(result.outcome, Outcome::degenerate);
    auto parked = object_processor::parked_triangle(24);
    parked.material = 7;
    EXPECT_EQ(result.words, parked);
    t[2].x = std::numeric_limits<double>::quiet_NaN();
    result = set_up_triangle(t, 7, true, grids_of(format).on_screen, format);
    EXPECT_EQ(result.outcome, Outcome::degenerate);
  }
  // An area that the snap takes away, though the corners differ: on the line y = 1/2 within half a step.
  const WordFormat format;
  Triangle t = front_face();
  t[0].x = 10.0, t[0].y = 0.5;
  t[1].x = 20.0, t[1].y = 0.509;
  t[2].x = 15.0, t[2].y = 0.492;
  EXPECT_EQ(set_up_triangle(t, 0, true, grids_of(format).on_screen, format).outcome, Outcome::degenerate);
}

TEST(TriangleSetUp, GivesTheSameWordsCounted) {
  Generator generator(31);
  for (const EdgeForm edges : {EdgeForm::snapped, EdgeForm::scaled})
    for (const Family family : {Family::small, Family::full_screen, Family::sliver})
      for (int i = 0; i < 200; ++i) {
        const WordFormat format{24, 512, 512, edges};
        const Triangle t = generator.triangle(family, 512.0);
        const geometry::SnapGrid grid = grids_of(format).on_screen;
        const SetUpResult plain = set_up_triangle(t, 1, i % 2 == 0, grid, format);
        const SetUpResult charged = set_up_triangle(counted(t), 1, i % 2 == 0, grid, format);
        ASSERT_EQ(plain.outcome, charged.outcome);
        ASSERT_EQ(plain.words, charged.words);
      }
}

TEST(TriangleSetUp, GivesTheSamePiecesCounted) {
  const WordFormat format;
  const geometry::FrameGrid frame = geometry::frame_grid(grids_of(format), true, viewport(format));
  const glm::dmat4 to_clip_space = glm::perspectiveRH_ZO(1.0, 1.0, 1.0, 10.0);
  const glm::dmat3 normals(0.5);
  Generator generator(32);
  std::size_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    geometry::ClipTriangle<double> plain;
    geometry::ClipTriangle<Number> charged;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 p{generator.uniform(-9, 9), generator.uniform(-9, 9), generator.uniform(-12, 4)};
      const glm::dvec3 n{generator.uniform(-1, 1), generator.uniform(-1, 1), generator.uniform(-1, 1)};
      plain[c] = transform_vertex<double>(p, n, to_clip_space, normals);
      charged[c] = transform_vertex<Number>(p, n, to_clip_space, normals);
    }
    const Pieces<double> cut = pieces(plain, frame, viewport(format));
    const Pieces<Number> cut_charged = pieces(charged, frame, viewport(format));
    ASSERT_EQ(cut.size, cut_charged.size);
    most = std::max(most, cut.size);
    for (std::size_t k = 0; k < cut.size; ++k)
      ASSERT_EQ(set_up_triangle(cut.triangles[k], 0, true, frame.grid, format).words,
                set_up_triangle(cut_charged.triangles[k], 0, true, frame.grid, format).words);
  }
  EXPECT_GE(most, 3U);  // clipping did cut into several
  EXPECT_LE(most, kMaxPieces);
}

// One triangle with its three vertices: the published estimate is about 210 floating-point operations, made of 28 a
// transform, 3 divisions, 15 a normal, 3 x 5 for edges and 4 x 12 for planes. Ours computes edges in integers and
// rounds what it loads. A factor of 1.5 either way would mean that something is computed twice, or not charged.
TEST(TriangleSetUp, CostsAboutWhatWasEstimated) {
  const WordFormat format;
  const geometry::SnapGrids grids = grids_of(format);
  const geometry::FrameGrid frame = geometry::frame_grid(grids, false, viewport(format));
  const glm::dmat4 to_clip_space = glm::perspectiveRH_ZO(1.0, 1.0, 1.0, 10.0);
  const geometry::OperationCounts before = geometry::operation_counts;
  geometry::ClipTriangle<Number> corners;
  const std::array<glm::dvec3, 3> positions{{{-1, -1, -5}, {1, -1, -5}, {0, 1, -6}}};
  for (std::size_t c = 0; c < 3; ++c)
    corners[c] = transform_vertex<Number>(positions[c], {0, 0, 1}, to_clip_space, glm::dmat3(1.0));
  const geometry::OperationCounts transformed = geometry::operation_counts;
  const Pieces<Number> cut = pieces(corners, frame, viewport(format));
  ASSERT_EQ(cut.size, 1U);
  const geometry::OperationCounts projected = geometry::operation_counts;
  const SetUpResult drawn = set_up_triangle(cut.triangles[0], 0, false, frame.grid, format);
  const geometry::OperationCounts after = geometry::operation_counts;
  ASSERT_EQ(drawn.outcome, Outcome::drawn);

  EXPECT_EQ((transformed - before).flops(), 3U * (24 + 15));
  EXPECT_EQ((projected - transformed).divide, 3U);
  const geometry::OperationCounts total = after - before;
  EXPECT_GT(total.flops(), 140U);
  EXPECT_LT(total.flops(), 315U);
  RecordProperty("flops_total", std::to_string(total.flops()));
  RecordProperty("flops_set_up", std::to_string((after - projected).flops()));
  RecordProperty("integer", std::to_string(total.integer));
  RecordProperty("integer_multiply", std::to_string(total.integer_multiply));

  // A back face is dropped before its coefficients are computed.
  const SetUpResult culled = set_up_triangle<Number>({cut.triangles[0][1], cut.triangles[0][0], cut.triangles[0][2]}, 0,
                                                     false, frame.grid, format);
  ASSERT_EQ(culled.outcome, Outcome::back_face);
  EXPECT_LT((geometry::operation_counts - after).flops() * 4, (after - projected).flops());
}

// Any finite clip-space corners, to the ends of double's range: no undefined behaviour (the sanitizers look), no edge
// that wraps.
TEST(TriangleSetUp, TakesAnyFiniteCorners) {
  const std::vector<double> extremes{0.0,
                                     -0.0,
                                     1.0,
                                     -1.0,
                                     5e-324,
                                     1e-300,
                                     -1e-300,
                                     1e300,
                                     -1e300,
                                     1e154,
                                     0.5,
                                     3.0,
                                     std::numeric_limits<double>::max(),
                                     std::numeric_limits<double>::lowest()};
  EXPECT_TRUE(rc::check("no word wraps", [&extremes] {
    const EdgeForm edges = *rc::gen::element(EdgeForm::snapped, EdgeForm::scaled);
    const WordFormat format{24, 512, *rc::gen::element<std::size_t>(512, 64, 1), edges};
    const geometry::FrameGrid frame =
        geometry::frame_grid(grids_of(format), *rc::gen::arbitrary<bool>(), viewport(format));
    geometry::ClipTriangle<double> corners;
    for (auto& corner : corners) {
      for (int i = 0; i < 4; ++i) corner.position[i] = *rc::gen::elementOf(extremes);
      for (int i = 0; i < 3; ++i) corner.normal[i] = *rc::gen::elementOf(extremes);
    }
    const Pieces<double> cut = pieces(corners, frame, viewport(format));
    for (const Triangle& piece : cut.list()) {
      const SetUpResult result = set_up_triangle(piece, 0, true, frame.grid, format);
      if (result.outcome != Outcome::drawn) continue;
      for (const LinearWords& edge : result.words.edges) RC_ASSERT(!wraps_on_screen(edge, format));
    }
  }));
}

}  // namespace
}  // namespace rastertlm::set_up::test
