#include "modules/shading/shade_tables.h"

#include <algorithm>
#include <cmath>

#include "modules/shading/table_filler.h"

namespace rastertlm::shading {
namespace {

constexpr int kHalf = 16;     // products are the high halves of those of 16-bit words
constexpr int kRounded = 15;  // or, of words with a sign, all but the low 15 bits, rounded
constexpr unsigned kWidestMagnitude = 11;
constexpr std::int64_t kWidestEntry = 12;  // of a dot-product table: the sum of three fits 16 bits with a sign
constexpr std::int64_t kLevelBits = 8;
constexpr std::size_t kSpareBytes = 3;  // a gather of bytes reads words

bool kernel_can(const ShadingParameters& p, unsigned magnitude_bits, unsigned product_shift) {
  const std::int64_t level_shift = p.index_bits + p.diffuse_fraction_bits + 1;
  return p.arithmetic == Arithmetic::centred && magnitude_bits <= kWidestMagnitude && p.level_bits == kLevelBits &&
         p.dot_table_output_bits <= kWidestEntry && p.materials <= static_cast<std::int64_t>(kKernelMaterials) &&
         p.normaliser_address_bits < kHalf && (p.materials << p.index_bits) <= (std::int64_t{1} << kHalf) &&
         product_shift <= kHalf && magnitude_bits + 1 <= product_shift && level_shift <= kRounded &&
         kLevelBits + p.diffuse_fraction_bits <= kRounded;
}

template <class Word>
bool is_ramp(std::span<const Word> table, const Ramp& ramp) {
  std::uint64_t sum = ramp.preset;
  bool same = true;
  for (const Word entry : table) {
    same = same && entry == sum >> ramp.error_bits;
    sum += ramp.increment;
  }
  return same;
}

}  // namespace

std::optional<std::uint16_t> product_word(std::span<const std::uint16_t> table, unsigned address_bits) {
  // The last entry is the word less one, or the word where it is 0.
  for (std::uint32_t word = table.back(); word <= table.back() + 1U; ++word)
    if (is_ramp(table, product_ramp(word, address_bits, Arithmetic::centred))) return static_cast<std::uint16_t>(word);
  return std::nullopt;
}

std::optional<std::uint16_t> level_word(std::span<const std::uint8_t> table, unsigned index_bits,
                                        unsigned fraction_bits) {
  // (2 i + 1) word + half is in [entry, entry + 1) steps: what the last entries leave to the word.
  constexpr std::size_t kEntries = 64;
  const std::int64_t half = std::int64_t{1} << (index_bits + fraction_bits);
  std::int64_t low = 0;
  std::int64_t high = (std::int64_t{1} << kRounded) - 1;
  for (std::size_t i = table.size() - std::min(kEntries, table.size()); i < table.size(); ++i) {
    const auto odd = static_cast<std::int64_t>(2 * i + 1);
    low = std::max(low, (2 * half * table[i] - half + odd - 1) / odd);
    high = std::min(high, (2 * half * (table[i] + 1) - half - 1) / odd);
  }
  for (std::int64_t word = low; word <= high; ++word)
    if (is_ramp(table, level_ramp(static_cast<std::uint32_t>(word), index_bits, fraction_bits, Arithmetic::centred)))
      return static_cast<std::uint16_t>(word);
  return std::nullopt;
}

std::optional<ShadeTables> ShadeTables::of(const TableBank& bank, const Normaliser& normaliser,
                                           const ShadingParameters& parameters, std::int64_t normal_bits,
                                           const std::vector<std::size_t>& lights, const ShadeKernels& kernels) {
  const auto magnitude_bits = static_cast<unsigned>(normal_bits - 1);
  const unsigned product_shift = normaliser.product_shift() + 1;  // of (2 m + 1) * root
  if (lights.empty() || !kernel_can(parameters, magnitude_bits, product_shift)) return std::nullopt;
  ShadeTables tables;
  ShadeRequest& c = tables.constants_;
  c.last_material = static_cast<std::uint32_t>(parameters.materials) - 1;
  c.magnitude_bits = magnitude_bits;
  c.root_shift = normaliser.address_shift();
  c.short_address = normaliser.short_limit() >> c.root_shift;  // the limit is a multiple: addresses have 4 bits or more
  c.product_lift = kHalf - product_shift;
  c.entry_lift = kHalf - static_cast<unsigned>(parameters.dot_table_address_bits) - 1;
  c.component_limit = static_cast<std::uint16_t>((1U << parameters.dot_table_address_bits) - 1);
  c.full_scale = static_cast<std::int16_t>((1 << (parameters.dot_table_output_bits + 1)) - 1);
  c.index_shift = static_cast<unsigned>(parameters.dot_table_output_bits - parameters.index_bits + 1);
  c.index_bits = static_cast<unsigned>(parameters.index_bits);
  c.diffuse_lift = kRounded - static_cast<unsigned>(parameters.index_bits + parameters.diffuse_fraction_bits + 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    c.background[channel] = bank.background[channel];
    for (std::size_t m = 0; m <= c.last_material; ++m) c.ambient[channel][m] = bank.ambient[3 * m + channel];
  }
  for (const std::size_t light : lights)
    if (!tables.read_light(bank, light, parameters)) return std::nullopt;
  tables.read_roots(normaliser, kernels);
  // Moving a vector leaves its words where they are.
  c.lights = tables.lights_.data();
  c.light_count = tables.lights_.size();
  return tables;
}

bool ShadeTables::read_light(const TableBank& bank, std::size_t light, const ShadingParameters& parameters) {
  ShadeLight& read = lights_.emplace_back();
  const DotTables* const dots[2] = {&bank.lights[light].diffuse, &bank.lights[light].specular};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto word = product_word(dots[k]->products[i], static_cast<unsigned>(parameters.dot_table_address_bits));
      if (!word) return false;
      read.word[k][i] = *word;
      read.flip[k][i] = dots[k]->negative[i] ? 0xFFFF : 0;
    }
  const MaterialTables& levels = bank.material_tables[light];
  const std::size_t entries = std::size_t{1} << constants_.index_bits;
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t m = 0; m <= constants_.last_material; ++m) {
      const auto table = std::span(levels.diffuse[channel]).subspan(m * entries, entries);
      const auto word =
          level_word(table, constants_.index_bits, static_cast<unsigned>(parameters.diffuse_fraction_bits));
      if (!word) return false;
      read.diffuse[channel][m] = *word;
    }
  auto& specular = specular_.emplace_back();
  for (std::size_t t = 0; t < levels.specular.size(); ++t) {
    specular[t] = levels.specular[t];
    specular[t].resize(specular[t].size() + kSpareBytes);
  }
  for (std::size_t channel = 0; channel < 3; ++channel)
    read.specular[channel] = specular[levels.specular.size() == 1 ? 0 : channel].data();
  for (std::size_t m = 0; m <= constants_.last_material; ++m) {
    std::size_t first = entries;
    for (const auto& table : levels.specular) {
      const auto begin = table.begin() + static_cast<std::ptrdiff_t>(m * entries);
      const auto shines =
          std::find_if(begin, begin + static_cast<std::ptrdiff_t>(first), [](auto level) { return level != 0; });
      first = static_cast<std::size_t>(shines - begin);
    }
    read.first_shining[m] = static_cast<std::uint16_t>(first);
  }
  return true;
}

// The ROM as arithmetic where the processor's arithmetic gives its words at all but a few addresses.
void ShadeTables::read_roots(const Normaliser& normaliser, const ShadeKernels& kernels) {
  root_ = normaliser.rom();
  const auto words = static_cast<std::uint32_t>(root_.size());
  root_.push_back(0);
  constants_.root = root_.data();
  if (kernels.roots == nullptr) return;
  RootArithmetic roots;
  roots.scale =
      static_cast<float>(normaliser.root_scale() / std::sqrt(std::ldexp(1.0, static_cast<int>(constants_.root_shift))));
  roots.limit = normaliser.largest_root();
  std::vector<std::uint32_t> computed(words + kHalf);
  kernels.roots(roots, words, computed.data());
  for (std::uint32_t address = 0; address < words; ++address) {
    if (computed[address] == root_[address]) continue;
    if (roots.exceptions == kRootExceptions) return;
    roots.address[roots.exceptions] = address;
    roots.root[roots.exceptions] = root_[address];
    ++roots.exceptions;
  }
  roots.usable = true;
  constants_.roots = roots;
}

}  // namespace rastertlm::shading
