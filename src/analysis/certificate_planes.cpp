// Edges, depth and normals of the object machine: from snapped corners to the words of EP1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "src/analysis/case_kind.h"
#include "src/analysis/case_kinds.h"
#include "src/analysis/certificate_steps.h"
#include "src/analysis/plane_bounds.h"
#include "src/analysis/plane_search.h"

namespace rastertlm::analysis {
namespace {

using report::ProofKind;

constexpr const char* kBounds = "src/analysis/plane_bounds.h";
constexpr const char* kTriangle = "triangle on the grid, sample in it";

void add_edges(const set_up::WordFormat& format, const PlaneSeen& seen, report::Certificates& all) {
  const char* const decides = "object_processor.edges";
  if (format.edges == set_up::EdgeForm::snapped)
    all.steps.push_back({"snapped edges, samples on the wrong side", decides, "edge on the grid, sample",
                         ProofKind::formula, "modules/set_up/edge_equations.h: integers that fit the word", "samples",
                         0.0, seen.wrong, seen.tests});
  else
    all.steps.push_back({"scaled edges, displacement", decides, "edge that crosses the screen", ProofKind::formula,
                         kBounds, "pixels", scaled_edge_bound(format), seen.displaced, seen.tests});
}

// The adder of one slice after the other is the sum modulo the word where the carry goes to the next slice's addition;
// of the carry as 004 has it nothing is proved.
void add_adder(const run::Inputs::Content& content, const imogene::Machine& machine, const CertifyOptions& options,
               report::Certificates& all) {
  const bool right = machine.object_processor.carry_clock == object_processor::CarryClock::clock1;
  const std::int64_t tries = std::max<std::int64_t>(4, options.tries / 1000);
  Trial trial{content, Numbers(options.seed), tries};
  const Measurement measured = linear_form_case()->measure(trial).measurements.front();
  all.steps.push_back({"EP1, wrong words", "ep1.carry_clock", "A, B, C, column and line", ProofKind::formula,
                       "modules/object_processor/elementary_processor.h: sums modulo the word", "words",
                       right ? 0.0 : std::numeric_limits<double>::infinity(), measured.measured,
                       static_cast<std::uint64_t>(tries)});
}

}  // namespace

void certify_planes(const run::Inputs::Content& content, const CertifyOptions& options, report::Certificates& all) {
  const auto& machine = std::get<imogene::Machine>(content.machine);
  const set_up::WordFormat format{static_cast<int>(machine.object_processor.word_bits),
                                  static_cast<std::size_t>(machine.video.columns),
                                  static_cast<std::size_t>(machine.video.lines), machine.object_processor.edges};
  const geometry::SnapGrids grids = imogene::snap_grids(machine);
  geometry::SnapGrids fitted = grids;  // of planes
  if (format.edges == set_up::EdgeForm::scaled)
    fitted.on_screen.fraction_bits = fitted.guarded.fraction_bits = set_up::kScaledFractionBits;
  const double large = area_within_margin(format, fitted);
  Numbers numbers(options.seed);
  const PlaneSeen seen = search_planes(format, grids, numbers, options.tries, large);
  add_edges(format, seen, all);
  add_adder(content, machine, options, all);
  const auto worst = [&](double largest, double area) {
    return std::max(plane_bound(format, fitted.on_screen, false, largest, area).total(),
                    plane_bound(format, fitted.guarded, true, largest, area).total());
  };
  const auto depths = static_cast<double>(set_up::far_depth(format) - set_up::near_depth(format));
  const double normals = 2 * static_cast<double>(set_up::normal_unit(format));
  const char* const decides = "object_processor.word_bits";
  all.steps.push_back({"depth", decides, kTriangle, ProofKind::formula, kBounds, "units", worst(depths, 1.0),
                       seen.depth, seen.samples});
  // Of so many squares of either grid: the coarser one's are larger.
  const int coarser = std::min(fitted.on_screen.fraction_bits, fitted.guarded.fraction_bits);
  const double pixels = std::ldexp(large / 2, -2 * coarser);
  all.steps.push_back({fmt::format("depth, whose margin is {}", set_up::depth_margin(format)), decides,
                       fmt::format("triangle of {:.3g} px2, sample in it", pixels), ProofKind::formula, kBounds,
                       "units", worst(depths, large), seen.depth_of_large, seen.samples});
  all.steps.push_back({fmt::format("normal, of 2^{}", format.word_bits - 2), decides, kTriangle, ProofKind::formula,
                       kBounds, "units", worst(normals, 1.0), seen.normal, 3 * seen.samples});
}

}  // namespace rastertlm::analysis
