#include "src/analysis/case_kinds.h"

#include "src/analysis/case_kind.h"

namespace rastertlm::analysis {

const quadratic::Machine* span_machine(const run::Inputs::Content& content) {
  if (const auto* found = std::get_if<quadratic::Machine>(&content.machine)) return found;
  return std::get_if<adaptive::Machine>(&content.machine);
}

const std::vector<NamedKind>& case_kinds() {
  static const std::vector<NamedKind> kinds{
      {"forward_differences", forward_differences_case},
      {"start_edge", start_edge_case},
      {"quadratic_solver", quadratic_solver_case},
      {"coverage", coverage_case},
      {"triangles", triangles_case},
      {"t_junctions", t_junctions_case},
      {"planes", planes_case},
      {"depth_order", depth_order_case},
      {"animation", animation_case},
      {"projection", projection_case},
      {"linear_form", linear_form_case},
      {"shading", shading_case},
      {"opposing_normals", opposing_normals_case},
      {"lighting", lighting_case},
      {"solids", solids_case},
  };
  return kinds;
}

}  // namespace rastertlm::analysis
