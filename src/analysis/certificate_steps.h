// One function a group of steps; each appends to the certificates of a machine.
#pragma once

#include "platforms/imogene/machine.h"
#include "platforms/quadratic/machine.h"
#include "src/analysis/certificates.h"
#include "src/analysis/measurement.h"

namespace rastertlm::analysis {

// Edges, depth and normals of the object machine, from corners to words.
void certify_planes(const run::Inputs::Content& content, const CertifyOptions& options, report::Certificates& all);
// Words and roots of solids, where the machine has quadric processors.
void certify_solids(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all);
// From those words to levels, step by step and as a whole.
void certify_shading(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all);
// The fewest bits of each width of the shading chain.
void certify_widths(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all);
// Machines with a span unit.
void certify_spans(const quadratic::Machine& machine, const CertifyOptions& options, report::Certificates& all);

}  // namespace rastertlm::analysis
