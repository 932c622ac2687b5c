#include "src/analysis/chain_tables.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"
#include "src/geometry/lighting.h"

namespace rastertlm::analysis {
namespace {

constexpr double kFull = 255.0;

double full_level(const shading::ShadingParameters& p) {
  return static_cast<double>(low_mask(static_cast<unsigned>(p.level_bits)));
}

LevelTable material_of(const std::vector<std::uint8_t>& words, std::size_t material,
                       const shading::ShadingParameters& p) {
  const std::size_t entries = std::size_t{1} << p.index_bits;
  LevelTable table(entries);
  for (std::size_t i = 0; i < entries; ++i) table[i] = words[material * entries + i] * kFull / full_level(p);
  return table;
}

double size_of(const Range& range) { return std::max(-range.low, range.high); }

}  // namespace

Curve diffuse_curve(double diffuse) {
  return [diffuse](double cosine) { return kFull * diffuse * cosine; };
}

Curve specular_curve(double specular, std::int64_t exponent) {
  return [specular, exponent](double cosine) {
    return kFull * specular * geometry::integer_power(cosine, static_cast<int>(exponent));
  };
}

LevelTable diffuse_table(const ShadingBench& bench, std::size_t quantity) {
  return material_of(bench.shader().front().material_tables[0].diffuse[0], quantity, bench.shader().parameters());
}

LevelTable specular_table(const ShadingBench& bench, std::size_t quantity) {
  return material_of(bench.shader().front().material_tables[0].specular[0], quantity, bench.shader().parameters());
}

double display_rounding(const shading::ShadingParameters& parameters) {
  return full_level(parameters) < kFull ? 0.5 : 0.0;
}

double ambient_rounding(const shading::ShadingParameters& parameters, const Quantity& quantity) {
  const double full = full_level(parameters);
  return std::fabs(static_cast<double>(round_half_up(full * quantity.ambient)) - full * quantity.ambient) * kFull /
         full;
}

double proved_level_error(const ShadingBench& bench, std::size_t quantity, std::span<const Range> sums) {
  const Quantity& q = bench.quantities()[quantity];
  Range error{0, 0};
  if (q.diffuse > 0.0) error = level_error(sums, diffuse_table(bench, quantity), diffuse_curve(q.diffuse));
  if (q.specular > 0.0) {
    const Range more = level_error(sums, specular_table(bench, quantity), specular_curve(q.specular, q.exponent));
    error = {error.low + more.low, error.high + more.high};
  }
  const shading::ShadingParameters& p = bench.shader().parameters();
  return size_of(error) + ambient_rounding(p, q) + display_rounding(p);
}

}  // namespace rastertlm::analysis
