// Proved worst errors of a machine's steps over every input, beside the worst that random and adversarial inputs find.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/report/certificates.h"
#include "src/run/inputs.h"

namespace rastertlm::analysis {

struct CertifyOptions {
  std::uint64_t seed = 1;
  std::int64_t tries = 20'000;          // random inputs a step, before the adversarial search
  double wanted_levels = 1.0;           // for which the fewest bits are told
  std::vector<std::int64_t> exponents;  // of the fewest bits; none: 10, 50 and 200, those that the machine has
};

// Everything but the machine's name. Throws InputError for an exponent that the machine does not have.
report::Certificates certify(const run::Inputs::Content& machine, const CertifyOptions& options);

}  // namespace rastertlm::analysis
