// The fewest bits of each width of the shading chain for a stated error: of its step alone, every other step exact.
// What several widths do together is the whole chain's certificate.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/analysis/certificate_steps.h"
#include "src/analysis/chain_tables.h"
#include "src/base/errors.h"

namespace rastertlm::analysis {
namespace {

using shading::ShadingParameters;

// A width with the step that it decides, and the range that a machine file may give.
struct Width {
  const char* parameter;
  ChainSteps steps;
  std::int64_t fewest;
  std::int64_t most;
  std::int64_t ShadingParameters::*member;  // none: normal_bits
};

ChainSteps only(bool ChainSteps::*step) {
  ChainSteps steps = ChainSteps::none();
  steps.*step = true;
  return steps;
}

std::vector<Width> widths_of(std::int64_t normal_bits) {
  return {{"object_processor.normal_bits", only(&ChainSteps::normal_word), 4, 16, nullptr},
          {"shading.normaliser_address_bits", only(&ChainSteps::root_address), 4,
           std::min<std::int64_t>(20, 2 * normal_bits), &ShadingParameters::normaliser_address_bits},
          {"shading.normaliser_output_bits", only(&ChainSteps::root_word), 4, 16,
           &ShadingParameters::normaliser_output_bits},
          {"shading.dot_table_address_bits", only(&ChainSteps::component), 4, 15,
           &ShadingParameters::dot_table_address_bits},
          {"shading.dot_table_output_bits", only(&ChainSteps::dot_product), 4, 15,
           &ShadingParameters::dot_table_output_bits},
          {"shading.index_bits", only(&ChainSteps::table), 3, 15, &ShadingParameters::index_bits}};
}

// As wide as it may be: what is exact must not stand in the way of the width that is tried.
ShadingParameters roomy(ShadingParameters p, std::int64_t normal_bits) {
  p.normaliser_address_bits = std::min<std::int64_t>(20, 2 * normal_bits);
  p.normaliser_output_bits = 16;
  p.dot_table_address_bits = 15;
  p.dot_table_output_bits = 15;
  return p;
}

struct Tried {
  ShadingParameters shading;
  object_processor::ObjectProcessorParameters object_processor;
};

Tried with(const imogene::Machine& machine, const Width& width, std::int64_t bits) {
  Tried tried{machine.shading, machine.object_processor};
  if (width.member == nullptr) tried.object_processor.normal_bits = bits;
  tried.shading = roomy(tried.shading, tried.object_processor.normal_bits);
  if (width.member != nullptr) tried.shading.*width.member = bits;
  ShadingParameters& p = tried.shading;
  p.dot_table_output_bits = std::min(p.dot_table_output_bits, p.dot_table_address_bits);
  p.index_bits = std::min(p.index_bits, p.dot_table_output_bits);
  return tried;
}

// The errors of every quantity in levels; not counting what the display rounds.
std::vector<double> errors_of(const Tried& tried, const Width& width, const std::vector<Quantity>& quantities) {
  const std::vector<Range> sums = sums_of(CosineBound(tried.shading, tried.object_processor.normal_bits, width.steps));
  std::vector<double> errors;
  if (width.steps.table) {
    ShadingBench bench(tried.shading, tried.object_processor, quantities);
    bench.set_light({0, 0, 1});
    for (std::size_t q = 0; q < quantities.size(); ++q)
      errors.push_back(proved_level_error(bench, q, sums) - display_rounding(tried.shading));
    return errors;
  }
  for (const Quantity& q : quantities) {
    const Curve curve = q.diffuse > 0.0 ? diffuse_curve(q.diffuse) : specular_curve(q.specular, q.exponent);
    const Range error = level_error(sums, {}, curve);
    errors.push_back(std::max(-error.low, error.high));
  }
  return errors;
}

std::vector<std::int64_t> exponents_of(const ShadingParameters& p, const CertifyOptions& options) {
  const auto has = [&](std::int64_t e) {
    return std::find(p.exponents.begin(), p.exponents.end(), e) != p.exponents.end();
  };
  const shading::PathRom rom(p);
  for (const std::int64_t exponent : options.exponents) static_cast<void>(rom.path(exponent, "--exponent"));
  if (!options.exponents.empty()) return options.exponents;
  std::vector<std::int64_t> found;
  for (const std::int64_t usual : {10, 50, 200})
    if (has(usual)) found.push_back(usual);
  if (found.empty()) found = p.exponents;
  return found;
}

}  // namespace

void certify_widths(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all) {
  std::vector<Quantity> quantities{{"diffuse", 0, 1, 0, machine.shading.exponents.front()}};
  for (const std::int64_t exponent : exponents_of(machine.shading, options))
    quantities.push_back({fmt::format("exponent {}", exponent), 0, 0, 1, exponent});
  for (const Quantity& q : quantities) all.quantities.push_back(q.name);
  const std::int64_t normal_bits = machine.object_processor.normal_bits;
  for (const Width& width : widths_of(normal_bits)) {
    report::GuardBits row{width.parameter, width.member == nullptr ? normal_bits : machine.shading.*width.member, {}};
    row.shares.resize(quantities.size());
    const std::vector<double> own = errors_of(with(machine, width, row.bits), width, quantities);
    for (std::size_t q = 0; q < own.size(); ++q) row.shares[q].proved = own[q];
    // From the fewest bits up, until every quantity has been met.
    for (std::int64_t bits = width.fewest; bits <= width.most; ++bits) {
      std::vector<Quantity> unmet;
      std::vector<std::size_t> which;
      for (std::size_t q = 0; q < quantities.size(); ++q)
        if (!row.shares[q].least) {
          unmet.push_back(quantities[q]);
          which.push_back(q);
        }
      if (unmet.empty()) break;
      const std::vector<double> errors = errors_of(with(machine, width, bits), width, unmet);
      for (std::size_t i = 0; i < errors.size(); ++i)
        if (errors[i] <= options.wanted_levels) row.shares[which[i]].least = bits;
    }
    all.guard_bits.push_back(std::move(row));
  }
}

}  // namespace rastertlm::analysis
