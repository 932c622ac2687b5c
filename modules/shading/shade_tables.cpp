#include "modules/shading/shade_tables.h"

#include <algorithm>

#include "modules/shading/table_filler.h"

namespace rastertlm::shading {
namespace {

constexpr unsigned kHalf = 16;  // products are the high halves of those of 16-bit words
constexpr std::uint32_t kAll = 0xFFFF;
constexpr std::int64_t kWidestSum = 12;  // of dot-product table entries: three and a carry fit 16 bits with a sign

std::uint32_t packed(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return red | green << 8 | blue << 16;
}

}  // namespace

std::optional<std::uint16_t> ramp_word(const std::vector<std::uint16_t>& table, unsigned address_bits) {
  // The last entry is the word less one, or the word where it is 0.
  for (std::uint32_t word = table.back(); word <= table.back() + 1U; ++word) {
    const Ramp ramp = product_ramp(word, address_bits, Arithmetic::centred);
    std::uint64_t sum = ramp.preset;
    bool same = true;
    for (const std::uint16_t entry : table) {
      same = same && entry == sum >> ramp.error_bits;
      sum += ramp.increment;
    }
    if (same) return static_cast<std::uint16_t>(word);
  }
  return std::nullopt;
}

std::optional<ShadeTables> ShadeTables::of(const TableBank& bank, const Normaliser& normaliser,
                                           const ShadingParameters& parameters, unsigned magnitude_bits,
                                           const std::vector<std::size_t>& lights) {
  constexpr unsigned kWidestMagnitude = 11;
  constexpr std::int64_t kLevelBits = 8;
  const unsigned product_shift = normaliser.product_shift() + 1;  // of (2 m + 1) * root
  if (parameters.arithmetic != Arithmetic::centred || magnitude_bits > kWidestMagnitude || lights.empty() ||
      parameters.level_bits != kLevelBits || parameters.dot_table_output_bits > kWidestSum || product_shift > kHalf ||
      magnitude_bits + 1 + kHalf - product_shift > kHalf)
    return std::nullopt;
  ShadeTables tables;
  ShadeRequest& c = tables.constants_;
  c.last_material = static_cast<std::uint32_t>(parameters.materials) - 1;
  c.background = packed(bank.background[0], bank.background[1], bank.background[2]);
  c.short_limit = normaliser.short_limit();
  c.magnitude_bits = magnitude_bits;
  c.root_shift = normaliser.address_shift();
  c.product_lift = kHalf - product_shift;
  c.entry_lift = kHalf - static_cast<unsigned>(parameters.dot_table_address_bits) - 1;
  c.component_limit = static_cast<std::uint16_t>((1U << parameters.dot_table_address_bits) - 1);
  c.full_scale = static_cast<std::int16_t>((1 << (parameters.dot_table_output_bits + 1)) - 1);
  c.index_shift = static_cast<unsigned>(parameters.dot_table_output_bits - parameters.index_bits + 1);
  c.index_bits = static_cast<unsigned>(parameters.index_bits);
  tables.root_ = normaliser.rom();
  tables.root_.push_back(0);
  for (const std::size_t light : lights)
    if (!tables.read_light(bank, light, parameters)) return std::nullopt;
  tables.add_ambient(bank, c.index_bits);
  // Moving a vector leaves its words where they are.
  for (std::size_t i = 0; i < lights.size(); ++i) {
    tables.lights_[i].diffuse = tables.diffuse_[i].data();
    tables.lights_[i].specular = tables.specular_[i].data();
  }
  return tables;
}

bool ShadeTables::read_light(const TableBank& bank, std::size_t light, const ShadingParameters& parameters) {
  ShadeLight& read = lights_.emplace_back();
  const DotTables* const dots[2] = {&bank.lights[light].diffuse, &bank.lights[light].specular};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto word =
          ramp_word(dots[k]->products[i], static_cast<unsigned>(parameters.dot_table_address_bits));
      if (!word) return false;
      read.word[k][i] = *word;
      read.flip[k][i] = dots[k]->negative[i] ? kAll : 0;
    }
  const MaterialTables& levels = bank.material_tables[light];
  const bool white = levels.specular.size() == 1;
  const std::size_t words = levels.diffuse[0].size();
  std::vector<std::uint32_t>& diffuse = diffuse_.emplace_back(words);
  std::vector<std::uint32_t>& specular = specular_.emplace_back(words);
  for (std::size_t i = 0; i < words; ++i) {
    diffuse[i] = packed(levels.diffuse[0][i], levels.diffuse[1][i], levels.diffuse[2][i]);
    specular[i] = packed(levels.specular[0][i], levels.specular[white ? 0 : 1][i], levels.specular[white ? 0 : 2][i]);
  }
  return true;
}

void ShadeTables::add_ambient(const TableBank& bank, unsigned index_bits) {
  const std::size_t materials = bank.ambient.size() / 3;
  for (std::size_t m = 0; m < materials; ++m) {
    const std::uint8_t* ambient = &bank.ambient[3 * m];
    ambient_.push_back(packed(ambient[0], ambient[1], ambient[2]));
    for (std::size_t i = m << index_bits; i < (m + 1) << index_bits; ++i) {
      std::uint32_t& word = diffuse_.front()[i];
      std::uint32_t sums[3];
      bool saturates = false;
      for (unsigned c = 0; c < 3; ++c) {
        sums[c] = (word >> (8 * c) & 0xFFU) + ambient[c];
        saturates = saturates || sums[c] > 0xFFU;
        sums[c] = std::min(sums[c], 0xFFU);
      }
      word = packed(sums[0], sums[1], sums[2]) | (saturates ? 1U << 24 : 0U);
    }
  }
}

ShadeRequest ShadeTables::request() const {
  ShadeRequest request = constants_;
  request.root = root_.data();
  request.lights = lights_.data();
  request.light_count = lights_.size();
  request.ambient = ambient_.data();
  return request;
}

}  // namespace rastertlm::shading
