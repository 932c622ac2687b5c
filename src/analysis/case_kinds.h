// Makes a case of each kind; what it measures stands in the source that is named.
#pragma once

#include <memory>

namespace rastertlm::analysis {

class CaseKind;

std::unique_ptr<CaseKind> forward_differences_case();  // stability_colours.cpp: a colour's registers, longest path
std::unique_ptr<CaseKind> start_edge_case();           // stability_start_edge.cpp: the same over triangles
std::unique_ptr<CaseKind> quadratic_solver_case();     // stability_solver.cpp: the solver of the six colours
std::unique_ptr<CaseKind> coverage_case();             // stability_coverage.cpp: the pixels that a mesh covers
std::unique_ptr<CaseKind> triangles_case();            // stability_triangles.cpp: the pixels of single triangles
std::unique_ptr<CaseKind> t_junctions_case();          // stability_t_junctions.cpp: vertices on others' edges
std::unique_ptr<CaseKind> planes_case();               // stability_planes.cpp: depths and normals of triangles
std::unique_ptr<CaseKind> depth_order_case();          // stability_depth_order.cpp: which of two triangles is seen
std::unique_ptr<CaseKind> animation_case();            // stability_animation.cpp: where things are after long
std::unique_ptr<CaseKind> projection_case();           // stability_projection.cpp: clipping, pixels, depths of a view
std::unique_ptr<CaseKind> linear_form_case();          // stability_linear_form.cpp: the adders of EP1
std::unique_ptr<CaseKind> shading_case();              // stability_shading.cpp: normals and lights at their limits
std::unique_ptr<CaseKind> opposing_normals_case();     // stability_opposing.cpp: normals that vanish on the way
std::unique_ptr<CaseKind> lighting_case();             // stability_lighting.cpp: light at points, of any exponent
std::unique_ptr<CaseKind> solids_case();               // stability_solids.cpp: outline, depth, normal of solids

}  // namespace rastertlm::analysis
