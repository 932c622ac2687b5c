#include "src/analysis/blame_shading.h"

#include <algorithm>
#include <cmath>

#include "src/base/fixed_point.h"

namespace rastertlm::analysis {
namespace {

using shading::Arithmetic;

constexpr double kFullScale = 255.0;

// The largest component of a vector, whatever its sign.
double largest(const glm::dvec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

}  // namespace

ShadingChain::ShadingChain(const shading::DeferredShader& shader,
                           const object_processor::ObjectProcessorParameters& processor,
                           std::span<const geometry::Reflectance> surfaces,
                           std::span<const geometry::LightSource> lights, const glm::dvec3& ambient_light)
    : shader_(shader),
      prenormaliser_(processor),
      surfaces_(surfaces),
      lights_(lights),
      ambient_light_(ambient_light),
      word_bits_(static_cast<unsigned>(processor.word_bits)),
      normal_unit_(std::ldexp(1.0, static_cast<int>(processor.word_bits) - 2)),
      largest_component_(std::ldexp(1.0, static_cast<int>(processor.normal_bits) - 1)),
      centred_(shader.parameters().arithmetic == Arithmetic::centred),
      // Centred, a light word of 1 is 2^bits and the adder counts halves; literal, it is 2^bits - 1.
      unit_sum_(centred_ ? std::ldexp(2.0, static_cast<int>(shader.parameters().dot_table_output_bits))
                         : std::ldexp(1.0, static_cast<int>(shader.parameters().dot_table_output_bits)) - 1.0),
      full_level_(static_cast<double>(low_mask(static_cast<unsigned>(shader.parameters().level_bits)))) {
  const glm::dvec3 viewer(0.0, 0.0, 1.0);
  for (const geometry::LightSource& light : lights_)
    halfway_.push_back(geometry::normalised<double>(light.vector + viewer));
}

// A word of `magnitude` as a number, in units of its last place.
double ShadingChain::word_value(std::uint32_t magnitude, bool negative) const {
  const double m = magnitude;
  if (centred_) return negative ? -(m + 0.5) : m + 0.5;
  return negative ? -(m + 1.0) : m;
}

ShadingChain::Components ShadingChain::pre_normalised(const PixelNormal& normal, StepSet exact) const {
  Components out;
  std::array<std::uint32_t, 3> words = normal.words;
  if (exact.has(Step::coefficients)) {
    out.real = normal.exact * normal_unit_;
    for (std::size_t i = 0; i < 3; ++i)
      words[i] = static_cast<std::uint32_t>(round_half_up(out.real[static_cast<int>(i)])) &
                 static_cast<std::uint32_t>(low_mask(word_bits_));
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      out.real[static_cast<int>(i)] = static_cast<double>(sign_extend(words[i], word_bits_));
  }
  if (exact.has(Step::pre_normalisation)) return out;
  out.is_words = true;
  out.link = prenormaliser_(words);
  return out;
}

// The normaliser's hardware given components that have not been cut: its ROM's addresses and words, its products.
ShadingChain::Direction ShadingChain::by_rom(const glm::dvec3& components) const {
  const shading::Normaliser& unit = shader_.normaliser();
  Direction out;
  out.is_words = true;
  const double size = largest(components);
  out.is_zero = size == 0.0;
  if (out.is_zero) return out;
  double scale = 1.0;
  while (size * scale >= largest_component_) scale *= 0.5;
  const glm::dvec3 m = components * scale;
  const double squares = m.x * m.x + m.y * m.y + m.z * m.z;
  const auto address = static_cast<std::size_t>(std::ldexp(squares, -static_cast<int>(unit.address_shift())));
  const double root = unit.rom()[std::min(address, unit.rom().size() - 1)];
  const auto clamp = static_cast<double>(low_mask(static_cast<unsigned>(shader_.parameters().dot_table_address_bits)));
  for (int i = 0; i < 3; ++i) {
    const double product = std::ldexp(std::fabs(m[i]) * root, -static_cast<int>(unit.product_shift()));
    out.words.magnitude[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(std::min(product, clamp));
    out.words.negative[static_cast<std::size_t>(i)] = m[i] < 0.0;
  }
  return out;
}

ShadingChain::Direction ShadingChain::normalised(const Components& components, bool exact) const {
  Direction out;
  if (!exact && !components.is_words) return by_rom(components.real);
  if (!exact) {
    out.is_words = true;
    out.words = shader_.normaliser().normalise(components.link[0], components.link[1], components.link[2]);
    out.is_zero = out.words.is_zero;
    return out;
  }
  glm::dvec3 direction = components.real;
  if (components.is_words) {
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const shading::SignMagnitude read = shader_.normaliser().read(components.link[i]);
      any = any || read.magnitude != 0;
      direction[static_cast<int>(i)] = word_value(read.magnitude, read.negative);
    }
    if (!any) direction = glm::dvec3(0.0);
  }
  out.real = geometry::normalised<double>(direction);
  out.is_zero = largest(direction) == 0.0;
  return out;
}

ShadingChain::Cosine ShadingChain::dot(const Direction& normal, const shading::DotTables& tables,
                                       const glm::dvec3& towards, bool exact) const {
  const auto address_bits = static_cast<int>(shader_.parameters().dot_table_address_bits);
  Cosine out;
  if (exact) {
    glm::dvec3 direction = normal.real;
    if (normal.is_words)
      for (std::size_t i = 0; i < 3; ++i)
        direction[static_cast<int>(i)] =
            std::ldexp(word_value(normal.words.magnitude[i], normal.words.negative[i]), -address_bits);
    out.real = geometry::dot<double>(direction, towards);
    return out;
  }
  out.is_words = true;
  shading::NormalisedNormal address = normal.words;
  if (!normal.is_words) {
    const auto last = static_cast<double>(low_mask(static_cast<unsigned>(address_bits)));
    for (int i = 0; i < 3; ++i) {
      const double scaled = std::ldexp(std::fabs(normal.real[i]), address_bits);
      address.magnitude[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(std::min(scaled, last));
      address.negative[static_cast<std::size_t>(i)] = normal.real[i] < 0.0;
    }
  }
  std::array<std::int32_t, 3> term{};
  for (std::size_t i = 0; i < 3; ++i)
    term[i] = shading::DotProduct::signed_term(tables.products[i][address.magnitude[i]],
                                               address.negative[i] != tables.negative[i]);
  out.sum = shader_.dot_product().sum(term[0], term[1], term[2]);
  return out;
}

std::size_t ShadingChain::index(const Cosine& cosine) const {
  if (cosine.is_words) return shader_.dot_product().index(cosine.sum);
  return shader_.dot_product().index(static_cast<std::int32_t>(std::clamp(cosine.real, 0.0, 1.0) * unit_sum_));
}

double ShadingChain::value(const Cosine& cosine) const {
  if (!cosine.is_words) return cosine.real;
  const std::int32_t full = (std::int32_t{1} << (shader_.parameters().dot_table_output_bits + (centred_ ? 1 : 0))) - 1;
  return static_cast<double>(std::min(cosine.sum, full)) / unit_sum_;
}

void ShadingChain::add_light(const Direction& normal, std::size_t light, std::uint32_t material, StepSet exact,
                             glm::dvec3& sum) const {
  const shading::TableBank& bank = shader_.front();
  const bool exact_dot = exact.has(Step::dot_product);
  const Cosine diffuse = dot(normal, bank.lights[light].diffuse, lights_[light].vector, exact_dot);
  const Cosine specular = dot(normal, bank.lights[light].specular, halfway_[light], exact_dot);
  const std::size_t base = std::size_t{material} << shader_.parameters().index_bits;
  const shading::MaterialTables& tables = bank.material_tables[light];
  const geometry::Reflectance& surface = surfaces_[material];
  const double cosine = value(diffuse);
  const double highlight = value(specular);
  const double power = highlight > 0.0 ? geometry::integer_power(highlight, surface.exponent) : 0.0;
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    if (!exact.has(Step::diffuse_table))
      sum[c] += tables.diffuse[channel][base + index(diffuse)] / full_level_;
    else if (cosine > 0.0)
      sum[c] += surface.diffuse[c] * lights_[light].diffuse_intensity[c] * cosine;
    const std::vector<std::uint8_t>& words = tables.specular[tables.specular.size() == 1 ? 0 : channel];
    if (!exact.has(Step::specular_table))
      sum[c] += words[base + index(specular)] / full_level_;
    else if (highlight > 0.0)
      sum[c] += surface.specular[c] * lights_[light].specular_intensity[c] * power;
  }
}

double ShadingChain::displayed(double sum, StepSet exact) const {
  if (exact.has(Step::output_rounding)) return std::clamp(kFullScale * sum, 0.0, kFullScale);
  const double level = std::min(std::floor(sum * full_level_ + 0.5), full_level_);
  // A converter of fewer bits still drives the display to full scale.
  return std::floor((level * 2.0 * kFullScale + full_level_) / (2.0 * full_level_));
}

glm::dvec3 ShadingChain::levels(const PixelNormal& normal, std::uint32_t material, StepSet exact) const {
  glm::dvec3 sum;
  for (int c = 0; c < 3; ++c)
    sum[c] = exact.has(Step::output_rounding)
                 ? surfaces_[material].ambient[c] * ambient_light_[c]
                 : shader_.front().ambient.at(3 * material + static_cast<std::size_t>(c)) / full_level_;
  const Direction direction = normalised(pre_normalised(normal, exact), exact.has(Step::normaliser));
  if (!direction.is_zero)
    for (std::size_t light = 0; light < lights_.size(); ++light) add_light(direction, light, material, exact, sum);
  return {displayed(sum.x, exact), displayed(sum.y, exact), displayed(sum.z, exact)};
}

}  // namespace rastertlm::analysis
