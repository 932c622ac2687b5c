#include "src/analysis/certificates.h"

#include <variant>

#include "src/analysis/certificate_steps.h"

namespace rastertlm::analysis {

report::Certificates certify(const run::Inputs::Content& machine, const CertifyOptions& options) {
  report::Certificates all;
  all.seed = options.seed;
  all.wanted_levels = options.wanted_levels;
  if (const auto* object = std::get_if<imogene::Machine>(&machine.machine)) {
    all.platform = "imogene";
    certify_planes(machine, options, all);
    certify_solids(*object, options, all);
    certify_shading(*object, options, all);
    certify_widths(*object, options, all);
  } else if (const auto* adaptive = std::get_if<adaptive::Machine>(&machine.machine)) {
    all.platform = "adaptive";
    certify_spans(*adaptive, options, all);
  } else {
    all.platform = "quadratic";
    certify_spans(std::get<quadratic::Machine>(machine.machine), options, all);
  }
  return all;
}

}  // namespace rastertlm::analysis
