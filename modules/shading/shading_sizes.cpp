// What the deferred shading processor is made of: the memory and logic budgets.
#include "modules/shading/deferred_shader.h"

namespace rastertlm::shading {

std::vector<MemorySize> DeferredShader::memories() const {
  const ShadingParameters& p = parameters_;
  const auto count = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  const std::uint64_t banks = banks_.size();
  const std::uint64_t lights = count(p.lights);
  const std::uint64_t materials = count(p.materials);
  const std::uint64_t dot_words = std::uint64_t{1} << p.dot_table_address_bits;
  const std::uint64_t level_words = materials << p.index_bits;
  const std::uint64_t level_bits = count(p.level_bits);
  return {
      {"shading.normaliser_rom", 1, std::uint64_t{1} << p.normaliser_address_bits, count(p.normaliser_output_bits)},
      {"shading.dot_tables", banks * lights * 6, dot_words, count(p.dot_table_output_bits)},
      {"shading.diffuse_tables", banks * lights * 3, level_words, level_bits},
      {"shading.specular_tables", banks * lights * count(p.specular_tables), level_words, level_bits},
      {"shading.light_signs", banks * lights, 1, 6},
      {"shading.ambient_registers", banks, 3 * materials, level_bits},
      {"shading.background_register", banks, 3, 8},
      // One ROM a specular loader, one bit a move.
      {"shading.path_rom", lights * count(p.specular_tables), path_rom_.paths() * path_rom_.moves(), 1},
  };
}

std::vector<LogicSize> DeferredShader::logic() const {
  const ShadingParameters& p = parameters_;
  const auto count = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
  const std::uint64_t lights = count(p.lights);
  const std::uint64_t half = p.arithmetic == Arithmetic::centred ? 1 : 0;
  const std::uint64_t sum_bits = count(p.dot_table_output_bits) + 3;
  // Each light adds its diffuse and specular level to the ambient one, in each channel.
  std::uint64_t level_sum_bits = count(p.level_bits);
  for (std::uint64_t terms = 2 * lights + 1; terms > 1; terms = (terms + 1) / 2) ++level_sum_bits;
  return {
      {"shading.squarers", 3, magnitude_bits_ + half},
      {"shading.square_adders", 2, 2 * std::uint64_t{magnitude_bits_} + 2},
      {"shading.normal_multipliers", 3, magnitude_bits_ + half},  // by normaliser_output_bits
      {"shading.dot_adders", lights * 2 * 2, sum_bits},
      {"shading.dot_comparators", lights * 2, sum_bits},  // full scale; the sign bit clears negatives
      {"shading.level_adders", 3 * 2 * lights, level_sum_bits},
      {"shading.level_comparators", 3, level_sum_bits},
  };
}

}  // namespace rastertlm::shading
