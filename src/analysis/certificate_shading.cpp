// The shading processor, step by step and as a whole.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/analysis/certificate_steps.h"
#include "src/analysis/chain_tables.h"
#include "src/analysis/shading_proofs.h"
#include "src/analysis/shading_search.h"
#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using report::ProofKind;
using shading::ShadingParameters;

constexpr const char* kProofs = "src/analysis/shading_proofs.h";
constexpr const char* kChain = "src/analysis/chain_bound.h";
constexpr const char* kNotShort = "normal that is not short";  // short ones darken: chain_bound.h

double size_of(const Range& range) { return std::max(-range.low, range.high); }

// Exhaustive where the core ran on every input.
ProofKind kind_of(const Proof& proof) { return proof.inputs > 0 ? ProofKind::exhaustive : ProofKind::formula; }

void add_normal_steps(const imogene::Machine& machine, const CosineBound& bound, const ShadingSeen& seen,
                      report::Certificates& all) {
  const auto& p = machine.object_processor;
  const char* const decides = "object_processor.normal_bits";
  const Proof word = prove_normal_words(p);
  const double word_seen = std::max(seen.normal_word, word.inputs > 0 && !word.holds() ? word.worst : 0.0);
  all.steps.push_back({"pre-normalisation, a component", decides,
                       fmt::format("word of {} bits, in each of its shifts", p.word_bits), kind_of(word), kProofs,
                       "last place", std::min(word.worst, word.closed_form), word_seen, 3 * seen.normals});
  const double sine = bound.largest_sine();
  all.steps.push_back({"pre-normalisation, the angle", decides, kNotShort, ProofKind::interval, kChain, "sine", sine,
                       seen.direction, seen.normals});
  // delta N is the error of a unit normal's component: of the normal's word, whose vector is not of unit length. The
  // chord of an angle is not longer than its tangent.
  all.steps.push_back({"diffuse light by the normal's word alone", decides, kNotShort, ProofKind::formula,
                       "004, section 5.3.3: delta I_D <= sqrt(3) I K_D delta N", "levels",
                       255 * sine / std::sqrt(1 - sine * sine), seen.normal_diffuse, seen.normals});
}

void add_cosine_steps(const imogene::Machine& machine, const CosineBound& bound, const ShadingSeen& seen,
                      report::Certificates& all) {
  const ShadingParameters& p = machine.shading;
  const bool enumerated = p.arithmetic == shading::Arithmetic::centred && bound.root_inputs() <= kExhaustive;
  all.steps.push_back({"inverse square root, relative", "shading.normaliser_address_bits",
                       fmt::format("sum of squares, {}", bound.root_inputs()),
                       enumerated ? ProofKind::exhaustive : ProofKind::interval, kChain, "1e-6",
                       1e6 * size_of(bound.root_error()), 1e6 * seen.inverse_root, seen.normals});
  all.steps.push_back({"normalised component", "shading.dot_table_address_bits", kNotShort, ProofKind::interval, kChain,
                       "last place", size_of(bound.component_error()), seen.component, 3 * seen.normals});
  all.steps.push_back({"light word", "shading.dot_table_output_bits", "unit vector", ProofKind::formula,
                       "the nearest word: a half", "last place", 0.5, seen.light_word, seen.normals});
  const double place = std::ldexp(1.0, static_cast<int>(p.dot_table_output_bits));
  all.steps.push_back({"N.L and N.H, before saturation", "shading.dot_table_output_bits",
                       fmt::format("{}, and light", kNotShort), ProofKind::interval, kChain,
                       fmt::format("1/{:.0f}", place), bound.largest_sum_error(), seen.sum, 2 * seen.normals});
}

void add_table_steps(const imogene::Machine& machine, Numbers& numbers, report::Certificates& all) {
  constexpr std::int64_t kTables = 24;
  const ShadingParameters& p = machine.shading;
  const auto add = [&](const std::string& step, const char* decides, const char* range, const char* unit,
                       const Proof& proof, const Proof& seen) {
    // A table beyond the closed form is wrong, whatever else is like it: then it is what was seen.
    const double worst_seen = std::max(seen.worst, proof.holds() ? 0.0 : proof.worst);
    all.steps.push_back({step, decides, range, kind_of(proof), kProofs, unit,
                         proof.holds() ? proof.worst : proof.closed_form, worst_seen, seen.inputs});
  };
  add("partial product", "shading.dot_table_output_bits", "entry of every light word", "last place",
      prove_product_tables(p), sample_product_tables(p, numbers, kTables));
  const Proof adder = prove_terminate_adder(p);
  add("terminate adder, wrong indices", "shading.index_bits", "sum of three products", "indices", adder,
      {0.0, adder.inputs, 0.0});
  add("diffuse table", "shading.diffuse_fraction_bits", "entry of every I Kd colour", "levels", prove_diffuse_tables(p),
      sample_diffuse_tables(p, numbers, kTables));
  for (const std::int64_t exponent : p.exponents)
    add(fmt::format("specular table, exponent {}", exponent), "shading.level_bits", "entry of every I Ks", "levels",
        prove_specular_tables(p, exponent), sample_specular_tables(p, exponent, numbers, kTables));
}

void add_chain(const ShadingBench& bench, std::span<const Range> sums, const ShadingSeen& seen,
               report::Certificates& all) {
  for (std::size_t q = 0; q < bench.quantities().size(); ++q)
    all.steps.push_back({"whole chain, " + bench.quantities()[q].name, "shading.*",
                         fmt::format("{}, and light", kNotShort), ProofKind::interval, kChain, "levels",
                         proved_level_error(bench, q, sums), seen.levels[q], seen.pixels / bench.quantities().size()});
}

std::vector<Quantity> quantities_of(const ShadingParameters& p) {
  std::vector<Quantity> list{{"diffuse", 0, 1, 0, p.exponents.front()}};
  for (const std::int64_t exponent : p.exponents)
    list.push_back({fmt::format("exponent {}", exponent), 0, 0, 1, exponent});
  const std::int64_t last = *std::max_element(p.exponents.begin(), p.exponents.end());
  list.push_back({fmt::format(".1 + .5 diffuse + .4 specular, {}", last), .1, .5, .4, last});
  return list;
}

}  // namespace

void certify_shading(const imogene::Machine& machine, const CertifyOptions& options, report::Certificates& all) {
  ShadingBench bench(machine.shading, machine.object_processor, quantities_of(machine.shading));
  Numbers numbers(options.seed);
  constexpr std::int64_t kNormalsALight = 200;
  const ShadingSeen seen =
      search_shading(bench, numbers, std::max<std::int64_t>(1, options.tries / kNormalsALight), kNormalsALight);
  const CosineBound bound(machine.shading, machine.object_processor.normal_bits);
  const std::vector<Range> sums = sums_of(bound);
  add_normal_steps(machine, bound, seen, all);
  add_cosine_steps(machine, bound, seen, all);
  add_table_steps(machine, numbers, all);
  add_chain(bench, sums, seen, all);
}

}  // namespace rastertlm::analysis
