// Machines with a span unit: from six colours, or three, to levels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/analysis/certificate_steps.h"
#include "src/analysis/span_bounds.h"
#include "src/analysis/span_search.h"

namespace rastertlm::analysis {
namespace {

using report::ProofKind;

constexpr const char* kBounds = "src/analysis/span_bounds.h";
constexpr std::int64_t kMostFractionBits = 40;

void add_colours(const quadratic::Machine& machine, const SpanSeen& seen, report::Certificates& all) {
  const std::string on_screen = fmt::format("triangle on the screen, {} px thick", kThinnest);
  const double solver = solver_bound(machine, kThinnest);
  all.steps.push_back({"solver", "set_up.solver", on_screen, ProofKind::formula, kBounds, "levels", solver, seen.solved,
                       seen.triangles});
  all.steps.push_back({"solver, thinner triangles", "set_up.arithmetic", "triangle on the grid", ProofKind::formula,
                       kBounds, "levels", solver_bound(machine, thinnest_on_grid(machine)), seen.thin_solved,
                       seen.triangles});
  if (!machine.set_up.linear()) {
    all.steps.push_back({"constants and forward differences", "span_unit.fraction_bits",
                         fmt::format("path of {} steps", longest_path(machine)), ProofKind::formula,
                         "span_unit::fraction_bound: 2^-(bits + 1) (k^2 + k + 2) / 2", "levels",
                         span_unit::fraction_bound(machine.span_unit.fraction_bits, longest_path(machine)),
                         longest_path_error(machine.span_unit, longest_path(machine)), 2});
  }
  const double registers = register_bound(machine, machine.span_unit.fraction_bits, kThinnest);
  all.steps.push_back({"registers along start edges and lines", "span_unit.start_edge", on_screen, ProofKind::formula,
                       kBounds, "levels", registers, seen.registers, seen.samples});
  all.steps.push_back({"output", "span_unit.fraction_bits", "word of a colour", ProofKind::formula,
                       "floor of 1/2 more, clamped: a half", "levels", 0.5, seen.rounded, seen.samples});
  all.steps.push_back({"whole colour", "span_unit.*, set_up.*", on_screen, ProofKind::formula, kBounds, "levels",
                       solver + registers + 0.5, seen.level, seen.samples});
}

void add_width(const quadratic::Machine& machine, const CertifyOptions& options, report::Certificates& all) {
  const auto proved = [&](std::int64_t bits) {
    return machine.set_up.linear() ? span_unit::linear_fraction_bound(bits, longest_path(machine))
                                   : span_unit::fraction_bound(bits, longest_path(machine));
  };
  all.quantities = {machine.set_up.linear() ? "linear colour" : "quadratic colour"};
  report::GuardBits row{"span_unit.fraction_bits", machine.span_unit.fraction_bits, {}};
  row.shares.resize(1);
  row.shares[0].proved = proved(row.bits);
  for (std::int64_t bits = 0; bits <= kMostFractionBits && !row.shares[0].least; ++bits)
    if (proved(bits) <= options.wanted_levels) row.shares[0].least = bits;
  all.guard_bits.push_back(std::move(row));
}

}  // namespace

void certify_spans(const quadratic::Machine& machine, const CertifyOptions& options, report::Certificates& all) {
  Numbers numbers(options.seed);
  const SpanSeen seen = search_spans(machine, numbers, std::max<std::int64_t>(1, options.tries / 10), kThinnest);
  all.steps.push_back({"edges, samples on the wrong side", "set_up.snap_bits", "triangle on the grid, sample",
                       ProofKind::formula, "modules/span_unit/span.h: columns in integers", "samples", 0.0, seen.wrong,
                       seen.ends});
  add_colours(machine, seen, all);
  all.steps.push_back({"depth", "span_unit.depth_fraction_bits",
                       fmt::format("triangle on the screen, {} px thick", kThinnest), ProofKind::formula, kBounds,
                       "units", depth_bound(machine, kThinnest), seen.depth, seen.samples});
  add_width(machine, options, all);
}

}  // namespace rastertlm::analysis
