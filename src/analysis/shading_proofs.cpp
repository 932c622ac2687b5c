#include "src/analysis/shading_proofs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <vector>

#include "modules/object_processor/prenormaliser.h"
#include "modules/shading/dot_product.h"
#include "modules/shading/path_rom.h"
#include "modules/shading/table_filler.h"
#include "src/base/fixed_point.h"
#include "src/base/mathematics.h"

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;
using shading::ShadingParameters;

std::uint64_t full_level(const ShadingParameters& p) { return low_mask(static_cast<unsigned>(p.level_bits)); }

// Levels of this machine in those of a display.
double display_scale(const ShadingParameters& p) { return 255.0 / static_cast<double>(full_level(p)); }

// The position of entry i: the centre of its interval, or as the paper has it.
double position(std::size_t i, const ShadingParameters& p, bool to_the_end) {
  const double entries = std::ldexp(1.0, static_cast<int>(p.index_bits));
  if (p.arithmetic == Arithmetic::centred) return (static_cast<double>(i) + 0.5) / entries;
  return static_cast<double>(i) / (to_the_end ? entries - 1 : entries);
}

using Table = std::vector<std::uint32_t>;
enum class Fill { fast, stepped };

template <class Filler>
void step_into(Filler filler, Table& table) {
  while (!filler.done()) {
    const shading::FillStep step = filler.step();
    if (step.stores) table[step.address] = step.value;
  }
}

void fill(const shading::Ramp& ramp, Fill how, Table& table) {
  table.resize(ramp.entries);
  if (how == Fill::fast) {
    shading::fill(ramp, std::span(table));
  } else {
    step_into(shading::RampFiller(ramp), table);
  }
}

// The table that the path draws with that coded Ks.
void fill(const ShadingParameters& p, const std::vector<shading::Move>& path, std::uint32_t ks, Fill how,
          Table& table) {
  const shading::PathScale scale = shading::path_scale(ks, static_cast<unsigned>(p.level_bits), p.arithmetic);
  table.resize(std::size_t{1} << p.index_bits);
  if (how == Fill::fast) {
    shading::fill(std::span<const shading::Move>(path), scale, std::span(table));
  } else {
    step_into(shading::PathFiller(path, scale), table);
  }
}

std::vector<shading::Move> path_of(const ShadingParameters& p, std::int64_t exponent) {
  return shading::path_of(shading::power_states(exponent, static_cast<unsigned>(p.index_bits),
                                                static_cast<unsigned>(p.level_bits), p.arithmetic),
                          static_cast<unsigned>(p.level_bits));
}

// What stands for Ks = 1.
std::uint32_t coded_one(const ShadingParameters& p) {
  return static_cast<std::uint32_t>(full_level(p)) + (p.arithmetic == Arithmetic::centred ? 1 : 0);
}

std::vector<double> powers(const ShadingParameters& p, std::int64_t exponent) {
  std::vector<double> values(std::size_t{1} << p.index_bits);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = mathematics::pow(position(i, p, true), static_cast<double>(exponent));
  return values;
}

std::uint32_t light_words(const ShadingParameters& p) {
  return (std::uint32_t{1} << p.dot_table_output_bits) + (p.arithmetic == Arithmetic::centred ? 1 : 0);
}

double product_error(const ShadingParameters& p, std::uint32_t word, Fill how, Table& table) {
  fill(shading::product_ramp(word, static_cast<unsigned>(p.dot_table_address_bits), p.arithmetic), how, table);
  const double half = p.arithmetic == Arithmetic::centred ? 0.5 : 0.0;
  const auto entries = static_cast<double>(table.size());
  double worst = 0.0;
  for (std::size_t n = 0; n < table.size(); ++n)
    worst = std::max(worst, std::fabs(table[n] + half - (static_cast<double>(n) + half) * word / entries));
  return worst;
}

unsigned fraction_bits_of(const ShadingParameters& p) {
  return p.arithmetic == Arithmetic::centred ? static_cast<unsigned>(p.diffuse_fraction_bits) : 0;
}
std::uint64_t diffuse_constants(const ShadingParameters& p) { return (full_level(p) << fraction_bits_of(p)) + 1; }

double diffuse_error(const ShadingParameters& p, std::uint64_t constant, Fill how, Table& table) {
  const unsigned fraction_bits = fraction_bits_of(p);
  fill(shading::level_ramp(static_cast<std::uint32_t>(constant), static_cast<unsigned>(p.index_bits), fraction_bits,
                           p.arithmetic),
       how, table);
  const double unit = std::ldexp(1.0, -static_cast<int>(fraction_bits));
  const auto word = static_cast<double>(constant);
  const double low = std::max(0.0, (word - 0.5) * unit);
  const double high = std::min(static_cast<double>(full_level(p)), (word + 0.5) * unit);
  double worst = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double x = position(i, p, false), level = table[i];
    worst = std::max({worst, std::fabs(level - low * x), std::fabs(level - high * x)});
  }
  return worst * display_scale(p);
}

double specular_error(const ShadingParameters& p, std::uint32_t ks, const std::vector<double>& exact,
                      const Table& table) {
  const std::uint32_t one = coded_one(p);
  const auto full = static_cast<double>(full_level(p));
  const double low = std::max(0.0, (ks - 0.5) / one), high = std::min(1.0, (ks + 0.5) / one);
  double worst = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double level = table[i];
    worst = std::max({worst, std::fabs(level - full * low * exact[i]), std::fabs(level - full * high * exact[i])});
  }
  return worst * display_scale(p);
}

// `error_of` on every constant of a table of `entries`, or the closed form where that is too much.
template <class ErrorOf>
Proof prove(std::uint64_t constants, std::uint64_t entries, double closed_form, const ErrorOf& error_of) {
  if (constants * entries > kExhaustive) return {closed_form, 0, closed_form};
  Proof proof{0.0, constants * entries, closed_form};
  for (std::uint64_t constant = 0; constant < constants; ++constant)
    proof.worst = std::max(proof.worst, error_of(constant));
  return proof;
}

// On the largest constant, and others at random.
template <class ErrorOf>
Proof sample(std::uint64_t constants, std::uint64_t entries, Numbers& numbers, std::int64_t tables,
             const ErrorOf& error_of) {
  Proof found;
  const auto last = static_cast<std::int64_t>(constants) - 1;
  for (std::int64_t i = 0; i < tables; ++i) {
    found.worst = std::max(found.worst, error_of(static_cast<std::uint64_t>(i == 0 ? last : numbers.whole(0, last))));
    found.inputs += entries;
  }
  return found;
}

}  // namespace

Proof prove_normal_words(const object_processor::ObjectProcessorParameters& parameters) {
  const auto word_bits = static_cast<unsigned>(parameters.word_bits);
  const auto normal_bits = static_cast<unsigned>(parameters.normal_bits);
  if ((std::uint64_t{1} << word_bits) > kExhaustive) return {0.5, 0, 0.5};
  const object_processor::Prenormaliser unit(parameters);
  Proof proof{0.0, 0, 0.5};
  for (unsigned shift = 0; shift <= unit.largest_shift(); ++shift) {
    const std::int64_t limit = std::int64_t{1} << (normal_bits - 1 + shift);
    // Another component with its top bit set makes this shift; without a shift none needs to.
    const auto companion = static_cast<std::uint32_t>(shift == 0 ? 0 : limit / 2);
    const double unit_size = std::ldexp(1.0, static_cast<int>(shift));
    for (std::int64_t word = -limit; word < limit; ++word) {
      const auto link = unit({static_cast<std::uint32_t>(wrap_unsigned(word, word_bits)), companion, 0});
      const double centre = 0.5 * object_processor::half_units(link[0], normal_bits);
      proof.worst = std::max(proof.worst, std::fabs(static_cast<double>(word) / unit_size - centre));
      ++proof.inputs;
    }
  }
  return proof;
}

Proof prove_terminate_adder(const ShadingParameters& p) {
  const shading::DotProduct unit(p);
  const bool centred = p.arithmetic == Arithmetic::centred;
  // A sum's units in one: 2^B, or in halves of it.
  const double one = std::ldexp(centred ? 2.0 : 1.0, static_cast<int>(p.dot_table_output_bits));
  const auto largest = (std::int32_t{1} << p.dot_table_output_bits) - 1;
  const double last = std::ldexp(1.0, static_cast<int>(p.index_bits)) - 1;
  Proof proof;
  for (std::int32_t terms = -3 * (largest + 1); terms <= 3 * largest; ++terms) {
    const std::int32_t sum = unit.sum(terms, 0, 0);
    const double index = std::clamp(std::floor(sum / one * (last + 1)), 0.0, last);
    proof.worst += unit.index(sum) == index ? 0.0 : 1.0;
    ++proof.inputs;
  }
  return proof;
}

Proof prove_product_tables(const ShadingParameters& p) {
  Table table;
  return prove(
      light_words(p), std::uint64_t{1} << p.dot_table_address_bits, p.arithmetic == Arithmetic::centred ? 0.5 : 1.0,
      [&](std::uint64_t word) { return product_error(p, static_cast<std::uint32_t>(word), Fill::fast, table); });
}

Proof sample_product_tables(const ShadingParameters& p, Numbers& numbers, std::int64_t tables) {
  Table table;
  return sample(light_words(p), std::uint64_t{1} << p.dot_table_address_bits, numbers, tables, [&](std::uint64_t word) {
    return product_error(p, static_cast<std::uint32_t>(word), Fill::stepped, table);
  });
}

Proof prove_diffuse_tables(const ShadingParameters& p) {
  Table table;
  const double floor = p.arithmetic == Arithmetic::centred ? 0.5 : 1.0;
  const double constant = std::ldexp(0.5, -static_cast<int>(fraction_bits_of(p)));
  return prove(diffuse_constants(p), std::uint64_t{1} << p.index_bits, display_scale(p) * (floor + constant),
               [&](std::uint64_t word) { return diffuse_error(p, word, Fill::fast, table); });
}

Proof sample_diffuse_tables(const ShadingParameters& p, Numbers& numbers, std::int64_t tables) {
  Table table;
  return sample(diffuse_constants(p), std::uint64_t{1} << p.index_bits, numbers, tables,
                [&](std::uint64_t word) { return diffuse_error(p, word, Fill::stepped, table); });
}

Proof prove_specular_tables(const ShadingParameters& p, std::int64_t exponent) {
  const std::vector<shading::Move> path = path_of(p, exponent);
  const std::vector<double> exact = powers(p, exponent);
  Table table;
  return prove(std::uint64_t{coded_one(p)} + 1, exact.size(),
               display_scale(p) * (p.arithmetic == Arithmetic::centred ? 1.5 : 3.0), [&](std::uint64_t ks) {
                 fill(p, path, static_cast<std::uint32_t>(ks), Fill::fast, table);
                 return specular_error(p, static_cast<std::uint32_t>(ks), exact, table);
               });
}

Proof sample_specular_tables(const ShadingParameters& p, std::int64_t exponent, Numbers& numbers, std::int64_t tables) {
  const std::vector<shading::Move> path = path_of(p, exponent);
  const std::vector<double> exact = powers(p, exponent);
  Table table;
  return sample(std::uint64_t{coded_one(p)} + 1, exact.size(), numbers, tables, [&](std::uint64_t ks) {
    fill(p, path, static_cast<std::uint32_t>(ks), Fill::stepped, table);
    return specular_error(p, static_cast<std::uint32_t>(ks), exact, table);
  });
}

double specular_table_error(const ShadingParameters& p, std::int64_t exponent, double specular) {
  const auto ks = static_cast<std::uint32_t>(round_half_up(coded_one(p) * specular));
  Table table;
  fill(p, path_of(p, exponent), ks, Fill::fast, table);
  const std::vector<double> exact = powers(p, exponent);
  double worst = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i)
    worst = std::max(worst, std::fabs(table[i] - static_cast<double>(full_level(p)) * specular * exact[i]));
  return worst * display_scale(p);
}

}  // namespace rastertlm::analysis
