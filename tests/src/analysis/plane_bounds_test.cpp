// Do planes, edges and spans keep to their bounds on any screen, and come near to them?
#include "src/analysis/plane_bounds.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "src/analysis/plane_search.h"
#include "src/analysis/span_bounds.h"
#include "src/analysis/span_search.h"

namespace rastertlm::analysis {
namespace {

double bound_of(const set_up::WordFormat& format, geometry::SnapGrids grids, double largest) {
  if (format.edges == set_up::EdgeForm::scaled)
    grids.on_screen.fraction_bits = grids.guarded.fraction_bits = set_up::kScaledFractionBits;
  return std::max(plane_bound(format, grids.on_screen, false, largest).total(),
                  plane_bound(format, grids.guarded, true, largest).total());
}

TEST(PlaneBounds, HoldOnAnyScreen) {
  EXPECT_TRUE(rc::check([] {
    set_up::WordFormat format;
    format.columns = *rc::gen::inRange<std::size_t>(16, 1025);
    format.lines = *rc::gen::inRange<std::size_t>(16, 1025);
    format.word_bits = *rc::gen::inRange(22, 29);
    format.edges = *rc::gen::element(set_up::EdgeForm::snapped, set_up::EdgeForm::scaled);
    const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, -1);
    if (!grids) return;
    Numbers numbers(*rc::gen::arbitrary<std::uint64_t>());
    const PlaneSeen seen = search_planes(format, *grids, numbers, 40);
    RC_ASSERT(seen.samples > 0U);
    RC_ASSERT(seen.wrong == 0.0);
    RC_ASSERT(seen.displaced <= scaled_edge_bound(format));
    const auto depths = static_cast<double>(set_up::far_depth(format) - set_up::near_depth(format));
    RC_ASSERT(seen.depth <= bound_of(format, *grids, depths));
    RC_ASSERT(seen.normal <= bound_of(format, *grids, 2.0 * static_cast<double>(set_up::normal_unit(format))));
  }));
}

// An anchor a few pixels away would be seen.
TEST(PlaneBounds, AreNearToWhatTheSearchFinds) {
  const set_up::WordFormat format;
  const auto grids = geometry::snap_grids(format.columns, format.lines, format.word_bits, -1);
  Numbers numbers(1);
  const PlaneSeen seen = search_planes(format, *grids, numbers, 4000);
  const double rounding = plane_bound(format, grids->on_screen, false, 0.0).rounding;
  EXPECT_EQ(rounding, 256.0);  // 0.5 ((w + h) / 2 + 1) of 511 x 511
  EXPECT_GT(seen.depth, 0.9 * rounding);
  EXPECT_GT(seen.normal, 0.9 * rounding);
}

TEST(SpanBounds, HoldAndAreBrokenByThePublishedStartEdge) {
  quadratic::Machine machine;
  Numbers numbers(1);
  const SpanSeen seen = search_spans(machine, numbers, 900, kThinnest);
  EXPECT_GT(seen.samples, 10'000U);
  EXPECT_EQ(seen.wrong, 0.0);
  EXPECT_LE(seen.solved, solver_bound(machine, kThinnest));
  EXPECT_LE(seen.thin_solved, solver_bound(machine, thinnest_on_grid(machine)));
  EXPECT_GT(seen.thin_solved, 10.0);  // of triangles of a few grid squares doubles have no right digit
  const double registers = register_bound(machine, machine.span_unit.fraction_bits, kThinnest);
  EXPECT_LE(seen.registers, registers);
  EXPECT_EQ(seen.rounded <= 0.5, true);
  EXPECT_LE(seen.depth, depth_bound(machine, kThinnest));
  machine.span_unit.start_edge = span_unit::StartEdge::published;
  EXPECT_GT(search_spans(machine, numbers, 90, kThinnest).registers, registers);
}

// What an independent program found for 1,024 steps of adversarial constants; bound and registers meet it.
TEST(SpanBounds, OfTheLongestPathAreThoseOfTheSpecification) {
  struct Row {
    std::int64_t bits;
    double levels;
  };
  for (const Row& row : {Row{8, 1025}, Row{10, 256}, Row{12, 64.1}, Row{14, 16.0}, Row{16, 4.00}, Row{18, 1.001},
                         Row{19, 0.5005}, Row{20, 0.250}, Row{22, 0.0626}, Row{24, 0.0156}}) {
    span_unit::SpanUnitParameters p;
    p.fraction_bits = row.bits;
    EXPECT_NEAR(span_unit::fraction_bound(row.bits, 1024), row.levels, 0.003 * row.levels) << row.bits;
    EXPECT_EQ(longest_path_error(p, 1024), span_unit::fraction_bound(row.bits, 1024)) << row.bits;
  }
}

TEST(SpanBounds, OfFewerFractionBitsAreBroken) {
  quadratic::Machine machine;
  const double wide = register_bound(machine, 20, kThinnest);
  machine.span_unit.fraction_bits = 12;
  Numbers numbers(2);
  const SpanSeen seen = search_spans(machine, numbers, 300, kThinnest);
  EXPECT_GT(seen.registers, wide);
  EXPECT_LE(seen.registers, register_bound(machine, 12, kThinnest));
}

}  // namespace
}  // namespace rastertlm::analysis
